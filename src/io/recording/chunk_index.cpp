// chunk_index.cpp -- a B-tree that is only ever appended to.

#include "io/recording/chunk_index.h"

#include <cassert>
#include <cstring>
#include <optional>
#include <utility>

namespace insonify {
namespace {

constexpr std::size_t kHeaderBytes = 24;     // Signature, type, level, entries, both neighbours.
constexpr std::size_t kRightNeighbour = 16;  // Where in a node that is.
constexpr std::uint64_t kAlignment = 8;      // Nodes are aligned so that an address in them lies within one page.

// Little-endian, as on every machine this is built for.
template <typename Number>
void put(Number number, std::vector<std::byte>& bytes) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof number);
  std::memcpy(&bytes[at], &number, sizeof number);
}

}  // namespace

ChunkIndex::ChunkIndex(std::vector<std::uint64_t> shape, std::uint64_t element_size) : shape_(std::move(shape)) {
  shape_.push_back(element_size);
}

std::size_t ChunkIndex::node_bytes() const {
  const std::size_t key = 8 + 8 * shape_.size();
  return kHeaderBytes + 2 * kHalfNode * 8 + (2 * kHalfNode + 1) * key;
}

// Where the chunk begins, in values along each axis and in bytes of a value; that of the end, as HDF5 has it, is one
// chunk on along all of them.
void ChunkIndex::put_key(const Key& key, std::vector<std::byte>& bytes) const {
  put(key.bytes, bytes);
  put(key.skipped_filters, bytes);
  put(key.row, bytes);
  for (std::size_t axis = 1; axis < shape_.size(); ++axis) {
    put(key.end ? shape_[axis] : std::uint64_t{0}, bytes);
  }
}

// Writes the rightmost node of a level to its unused place.
// @return  That place.
std::uint64_t ChunkIndex::write(std::size_t level, const Key& last, std::uint64_t& end, FilePieces& pieces) {
  Node& node = nodes_[level];
  node.place = 1 - node.place;
  std::uint64_t& place = node.places[node.place];
  if (place == kNowhere) {
    place = (end + kAlignment - 1) / kAlignment * kAlignment;
    end = place + node_bytes();
  }
  std::vector<std::byte>& bytes = pieces.add(place);
  for (const char letter : {'T', 'R', 'E', 'E'}) {
    put(letter, bytes);
  }
  put(std::uint8_t{1}, bytes);
  put(static_cast<std::uint8_t>(level), bytes);
  put(static_cast<std::uint16_t>(node.count), bytes);
  put(node.left, bytes);
  put(kNowhere, bytes);
  for (std::size_t i = 0; i < node.count; ++i) {
    put_key(node.entries[i].key, bytes);
    put(node.entries[i].child, bytes);
  }
  put_key(last, bytes);
  bytes.resize(node_bytes());
  return place;
}

// From the leaf up to the root: each level gets one entry more or, where none is left over from the level below, the
// new place of the node below.
void ChunkIndex::add(const Chunk& chunk, std::uint64_t& end, FilePieces& pieces) {
  const Key key{chunk.first_row, chunk.bytes, chunk.skipped_filters};
  const Key last{.row = chunk.first_row + shape_[0], .end = true};
  std::optional<Entry> more = Entry{key, chunk.address};
  std::uint64_t below = kNowhere;
  if (nodes_.empty()) {
    nodes_.emplace_back();
  }
  for (std::size_t level = 0;; ++level) {
    std::optional<Entry> full;  // The previous rightmost node, if it has changed.
    if (more && nodes_[level].count == nodes_[level].entries.size()) {
      const std::uint64_t left = nodes_[level].left;
      full = Entry{nodes_[level].entries.front().key, write(level, more->key, end, pieces)};
      if (left != kNowhere) {
        put(full->child, pieces.add(left + kRightNeighbour));
      }
      nodes_[level] = {};
      nodes_[level].left = full->child;
    }
    Node& node = nodes_[level];
    if (more) {
      node.entries[node.count++] = *more;
    } else {
      node.entries[node.count - 1].child = below;
    }
    const Key first = node.entries.front().key;
    below = write(level, last, end, pieces);
    const bool is_root = level + 1 == nodes_.size();
    if (is_root && !full) {
      root_ = below;
      return;
    }
    if (is_root) {
      nodes_.emplace_back();
      nodes_.back().count = 1;
      nodes_.back().entries[0] = *full;
    } else if (full) {
      nodes_[level + 1].entries[nodes_[level + 1].count - 1].child = full->child;
    }
    more = full ? std::optional(Entry{first, below}) : std::nullopt;
  }
}

void ChunkIndex::change_last(std::uint32_t bytes, std::uint32_t skipped_filters, std::uint64_t& end,
                             FilePieces& pieces) {
  Key& chunk = nodes_.front().entries[nodes_.front().count - 1].key;
  chunk = {chunk.row, bytes, skipped_filters};
  const Key last{.row = chunk.row + shape_[0], .end = true};
  for (std::size_t level = 0; level < nodes_.size(); ++level) {
    root_ = write(level, last, end, pieces);
    if (level + 1 < nodes_.size()) {
      Node& above = nodes_[level + 1];
      above.entries[above.count - 1] = {nodes_[level].entries.front().key, root_};
    }
  }
}

void ChunkIndex::close(FilePieces& pieces) const {
  for (const Node& node : nodes_) {
    if (node.left != kNowhere) {
      put(node.places[node.place], pieces.add(node.left + kRightNeighbour));
    }
  }
}

}  // namespace insonify
