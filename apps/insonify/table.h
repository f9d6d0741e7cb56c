// table.h -- rows of words in columns.

#pragma once

#include <string>
#include <vector>

namespace insonify {

using Row = std::vector<std::string>;

/// Prints rows with columns as wide as their widest cell; the last column is left as it is.
void print_table(const std::vector<Row>& rows);

}  // namespace insonify
