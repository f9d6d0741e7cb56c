// guarded.cpp -- reports an error in one line and returns the exit status.

#include "console/guarded.h"

#include <csignal>
#include <new>

#include "console/console.h"
#include "console/outcome.h"

namespace insonify {
namespace {

int status_of(const std::function<int()>& program) {
  try {
    return program();
  } catch (const InputError& error) {
    complain(error.what());
    return kWrongInput;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return kFailed;
}

}  // namespace

int run_guarded(const std::function<int()>& program) {
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // Exceeding a file size limit becomes an ordinary write error.
  return finish_output(status_of(program));
}

}  // namespace insonify
