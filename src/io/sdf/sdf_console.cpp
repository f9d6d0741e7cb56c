// sdf_console.cpp -- a stream buffer that captures one thread's output and forwards that of others.

#include "io/sdf/sdf_console.h"

#include <algorithm>
#include <iostream>
#include <sstream>
#include <streambuf>
#include <thread>

namespace insonify {

class SdfConsole::Buffer : public std::streambuf {
 public:
  Buffer() : shown_(std::cerr.rdbuf(this)) {}
  ~Buffer() override { std::cerr.rdbuf(shown_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] const std::string& kept() const { return kept_; }

 protected:
  int_type overflow(int_type c) override {
    if (std::this_thread::get_id() != owner_) {
      return shown_->sputc(traits_type::to_char_type(c));
    }
    kept_ += traits_type::to_char_type(c);
    return c;
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    if (std::this_thread::get_id() != owner_) {
      return shown_->sputn(text, size);
    }
    kept_.append(text, static_cast<std::size_t>(size));
    return size;
  }
  int sync() override { return shown_->pubsync(); }

 private:
  std::thread::id owner_ = std::this_thread::get_id();
  std::string kept_;
  std::streambuf* shown_;
};

SdfConsole::SdfConsole() : buffer_(std::make_unique<Buffer>()) {}
SdfConsole::~SdfConsole() = default;

std::vector<std::string> SdfConsole::sentences() const {
  // Lines look like "\033[1;33mWarning [Model.cc:174]\033[0m Non-unique name ...". Others come from elsewhere.
  constexpr std::string_view kStart = "\033[1;";
  constexpr std::string_view kEndOfLabel = "\033[0m ";
  std::vector<std::string> found;
  std::istringstream lines(buffer_->kept());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t end = line.find(kEndOfLabel);
    if (!line.starts_with(kStart) || end == std::string::npos) {
      continue;
    }
    std::string sentence = line.substr(end + kEndOfLabel.size());
    sentence.erase(sentence.find_last_not_of(". \t\r") + 1);
    if (std::find(found.begin(), found.end(), sentence) == found.end()) {
      found.push_back(std::move(sentence));
    }
  }
  return found;
}

}  // namespace insonify
