// error.cpp -- makes every error message printable, whatever it quotes.

#include "insonify/error.h"

#include "insonify/printable.h"

namespace insonify {

Error::Error(const std::string& message) : std::runtime_error(printable(message, kLongestMessage)) {}

}  // namespace insonify
