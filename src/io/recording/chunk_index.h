// chunk_index.h -- HDF5's index of a dataset's chunks, as plain bytes to write.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace insonify {

/// One chunk of a dataset: some of its rows, all of their values.
struct Chunk {
  std::uint64_t first_row = 0;
  std::uint64_t address = 0;          ///< In the file [bytes].
  std::uint32_t bytes = 0;            ///< Size in the file [bytes].
  std::uint32_t skipped_filters = 0;  ///< Bit n: it did not go through filter n.
};

/// Bytes and their position in the file.
struct FilePiece {
  std::uint64_t address = 0;
  std::vector<std::byte> bytes = {};
};

/// A list of file pieces that reuses its memory.
class FilePieces {
 public:
  void clear() { count_ = 0; }

  /// Adds a piece without bytes.
  std::vector<std::byte>& add(std::uint64_t address) {
    if (count_ == pieces_.size()) {
      pieces_.emplace_back();
    }
    FilePiece& piece = pieces_[count_++];
    piece.address = address;
    piece.bytes.clear();
    return piece.bytes;
  }

  [[nodiscard]] std::span<const FilePiece> all() const { return {pieces_.data(), count_}; }

 private:
  std::vector<FilePiece> pieces_;
  std::size_t count_ = 0;
};

/// A version 1 B-tree of chunks that follow each other along the first axis: "HDF5 File Format Specification Version
/// 2.0", section III.A.1, node type 1. It only grows at its right edge.
///
/// Nodes that a reader may be using are not overwritten: each node at the right edge has two places in the file, and
/// its next version goes to the unused one. So the tree from before add() stays intact after the new pieces are
/// written, and the new tree takes effect when the dataset's header gets the address of its root. A full node no longer
/// moves. Only then do its neighbours point to it: the last nodes that are not full lack links to their right, which
/// searches do not follow; close() completes them.
class ChunkIndex {
 public:
  /// @param shape         Of a chunk: rows, then the values of a row, axis by axis.
  /// @param element_size  [bytes]
  ChunkIndex(std::vector<std::uint64_t> shape, std::uint64_t element_size);

  /// Bytes of a node in the file.
  [[nodiscard]] std::size_t node_bytes() const;

  /// Adds the chunk after the last.
  /// @param end     End of the file; advances by the new nodes' places.
  /// @param pieces  Receives the pieces to write before root() takes effect.
  void add(const Chunk& chunk, std::uint64_t& end, FilePieces& pieces);

  /// Changes size and filters of the last chunk.
  /// @param end, pieces  As for add().
  void change_last(std::uint32_t bytes, std::uint32_t skipped_filters, std::uint64_t& end, FilePieces& pieces);

  /// Completes the links between nodes; nothing may be added afterwards.
  void close(FilePieces& pieces) const;

  /// Address of the root; all ones while there are no chunks.
  [[nodiscard]] std::uint64_t root() const { return root_; }

 private:
  // Half of a node's capacity, with superblocks of version 0.
  static constexpr std::size_t kHalfNode = 32;

  struct Key {
    std::uint64_t row = 0;
    std::uint32_t bytes = 0, skipped_filters = 0;
    bool end = false;  // Right of the last chunk.
  };
  struct Entry {
    Key key;
    std::uint64_t child = 0;
  };
  // The rightmost node of a level.
  struct Node {
    std::array<Entry, 2 * kHalfNode> entries = {};
    std::size_t count = 0;
    std::uint64_t left = kNowhere;  // Neighbour.
    std::array<std::uint64_t, 2> places = {kNowhere, kNowhere};
    int place = 1;  // Place of its last version.
  };
  static constexpr std::uint64_t kNowhere = ~std::uint64_t{0};

  std::uint64_t write(std::size_t level, const Key& last, std::uint64_t& end, FilePieces& pieces);
  void put_key(const Key& key, std::vector<std::byte>& bytes) const;

  std::vector<std::uint64_t> shape_;  // With the size of an element at its end.
  std::vector<Node> nodes_;           // The rightmost node of each level, leaves first.
  std::uint64_t root_ = kNowhere;
};

}  // namespace insonify
