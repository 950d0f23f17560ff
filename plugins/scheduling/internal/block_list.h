#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace runnel::internal {

/// Items in an order that changes little at a time: a list of blocks of at most kRoom items, in
/// which finding out which of two items comes first, and taking one out or putting one in, costs the
/// same however many there are. Each block has a label that grows along the list; an item knows its
/// block and its place in it. Where two labels leave no room between them all blocks are labelled
/// anew: their number is a small part of that of the items, and it seldom happens.
///
/// @tparam Item   has a public member `BlockPlace<Item> place` and a function `rank()`, which is 0, 1
///                or 2 and does not change; belongs to someone else.
/// Threads:  one at a time. Source: Dietz, Sleator, "Two algorithms for maintaining order in a list"
///           (1987), whose two levels these are.
template <typename Item>
struct Block {
  std::vector<Item*> items;
  std::array<std::size_t, 3> of_rank{};  ///< how many items have it
  std::uint64_t label = 0;
  std::size_t index = 0;                   ///< among the blocks
  bool is_changed = true;                  ///< since somebody set it to false
  std::shared_ptr<const void> made_of_it;  ///< by that somebody
};

template <typename Item>
struct BlockPlace {
  Block<Item>* block = nullptr;
  std::size_t index = 0;

  [[nodiscard]] bool IsBefore(const BlockPlace& other) const noexcept {
    return block == other.block ? index < other.index : block->label < other.block->label;
  }
};

template <typename Item>
class BlockList {
 public:
  static constexpr std::size_t kRoom = 64;
  using Blocks = std::vector<std::unique_ptr<Block<Item>>>;

  [[nodiscard]] const Blocks& blocks() const noexcept { return blocks_; }

  /// Grows whenever the order or the items change.
  [[nodiscard]] std::uint64_t changes() const noexcept { return changes_; }

  void Append(Item& item) {
    if (blocks_.empty() || blocks_.back()->items.size() >= kRoom / 2) InsertBlock(blocks_.size());
    Insert(item, *blocks_.back(), blocks_.back()->items.size());
  }
  /// Behind the last item of no higher rank; where there is none, first.
  void InsertByRank(Item& item) {
    for (std::size_t i = blocks_.size(); i-- > 0;) {
      Block<Item>& block = *blocks_[i];
      std::size_t lower = 0;
      for (std::size_t rank = 0; rank <= item.rank(); ++rank) lower += block.of_rank[rank];
      if (lower == 0) continue;
      std::size_t index = block.items.size();
      while (block.items[index - 1]->rank() > item.rank()) --index;
      return Insert(item, block, index);
    }
    if (blocks_.empty()) InsertBlock(0);
    Insert(item, *blocks_.front(), 0);
  }
  void InsertAfter(Item& item, const Item& other) {
    Insert(item, *other.place.block, other.place.index + 1);
  }
  void InsertBefore(Item& item, const Item& other) {
    Insert(item, *other.place.block, other.place.index);
  }
  void Remove(Item& item) {
    Block<Item>& block = *item.place.block;
    block.items.erase(block.items.begin() + static_cast<std::ptrdiff_t>(item.place.index));
    Number(block, item.place.index);
    --block.of_rank[item.rank()];
    item.place = {};
    if (block.items.empty()) return RemoveBlock(block.index);
    // Else a list of which much has been taken out would be one of many small blocks.
    if (block.index + 1 < blocks_.size()) MergeIfSmall(block.index);
    if (block.index > 0) MergeIfSmall(block.index - 1);
  }

 private:
  static constexpr std::uint64_t kLast = std::numeric_limits<std::uint64_t>::max();

  // Also says that the block has changed.
  void Number(Block<Item>& block, std::size_t first) noexcept {
    for (std::size_t i = first; i < block.items.size(); ++i) block.items[i]->place = {&block, i};
    block.is_changed = true;
    ++changes_;
  }

  static void Count(Block<Item>& block) noexcept {
    block.of_rank = {};
    for (const Item* item : block.items) ++block.of_rank[item->rank()];
  }

  void Insert(Item& item, Block<Item>& block, std::size_t index) {
    block.items.insert(block.items.begin() + static_cast<std::ptrdiff_t>(index), &item);
    Number(block, index);
    ++block.of_rank[item.rank()];
    if (block.items.size() > kRoom) Split(block);
  }

  void Split(Block<Item>& block) {
    Block<Item>& second = InsertBlock(block.index + 1);
    const auto middle = block.items.begin() + static_cast<std::ptrdiff_t>(block.items.size() / 2);
    second.items.assign(middle, block.items.end());
    block.items.erase(middle, block.items.end());
    Number(second, 0);
    Count(block);
    Count(second);
  }

  void MergeIfSmall(std::size_t index) {
    Block<Item>& first = *blocks_[index];
    Block<Item>& second = *blocks_[index + 1];
    if (first.items.size() + second.items.size() > kRoom / 4) return;
    const std::size_t middle = first.items.size();
    first.items.insert(first.items.end(), second.items.begin(), second.items.end());
    Number(first, middle);
    Count(first);
    RemoveBlock(index + 1);
  }

  Block<Item>& InsertBlock(std::size_t index) {
    blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(index),
                   std::make_unique<Block<Item>>());
    NumberBlocks(index);
    const std::uint64_t before = index > 0 ? blocks_[index - 1]->label : 0;
    const std::uint64_t after = index + 1 < blocks_.size() ? blocks_[index + 1]->label : kLast;
    // At the end, where most is added, steps are even and not halved.
    const std::uint64_t step = after == kLast ? kStep : (after - before) / 2;
    if (step == 0 || after - before <= step) {
      LabelAnew();
    } else {
      blocks_[index]->label = before + step;
    }
    return *blocks_[index];
  }

  void RemoveBlock(std::size_t index) {
    blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(index));
    NumberBlocks(index);
  }

  void NumberBlocks(std::size_t first) noexcept {
    for (std::size_t i = first; i < blocks_.size(); ++i) blocks_[i]->index = i;
  }

  void LabelAnew() noexcept {
    std::uint64_t label = 0;
    for (const auto& block : blocks_) block->label = label += kStep;
  }

  static constexpr std::uint64_t kStep = std::uint64_t{1} << 40;

  Blocks blocks_;
  std::uint64_t changes_ = 0;
};

}  // namespace runnel::internal
