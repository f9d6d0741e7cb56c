// table.h -- prints tables with aligned columns.

#pragma once

#include <string>
#include <vector>

namespace insonify {

using Row = std::vector<std::string>;

/// Prints rows with columns as wide as their widest cell; the last column is not padded.
void print_table(const std::vector<Row>& rows);

}  // namespace insonify
