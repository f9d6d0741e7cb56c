"""The check of function lengths counts what it should."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from check_functions import functions_of

TEXT = """#define TABLE { \\
  1
namespace {
struct alignas(8) Table {
  int size() const { return 1; }
  std::string text() const {
    return "{" + R"({{)";  // }
  }
};
constexpr Table kTable = {};
template <typename Value>
requires std::is_enum_v<Value>
void visit(const Value& value) {
  const auto each = [&](int one) {
    if (one == '{') {
      use(value);
    }
  };
  for (const int one : {1, 2}) {
    each(one);
  }
}
}  // namespace
Table::Table(int size) : size_(size) {
  fill();
}
"""

found = list(functions_of(TEXT))
assert found == [(5, 0), (6, 1), (13, 8), (24, 1)], found
print("4 functions, as long as they are")
