// table.cpp -- prints tables with aligned columns.

#include "console/table.h"

#include <fmt/format.h>

#include <algorithm>

#include "console/console.h"

namespace insonify {

void print_table(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows) {
    for (std::size_t column = 0; column + 1 < row.size(); ++column) {
      widths[column] = std::max(widths[column], row[column].size());
    }
  }
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column) {
      line += fmt::format("{:<{}}  ", row[column], widths[column]);
    }
    say("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
  }
}

}  // namespace insonify
