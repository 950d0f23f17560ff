#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "plugins/scheduling/internal/block_list.h"

namespace runnel::internal {

/// Two searches at once in an order: what can be reached from `to`, and what reaches `from`, each as
/// far as the other's start. Whichever has less to look at goes on, so a change costs what the
/// smaller of both costs.
///
/// @tparam Node   an item of the list with `std::uint64_t mark`, the search's own.
/// @tparam Edges  has `ForEachNext(node, visit)`, `ForEachPrevious(node, visit)`, and `Work(node)`,
///                the effort of either.
template <typename Node, typename Edges>
class OrderKeeper {
 public:
  OrderKeeper(BlockList<Node>& list, std::uint64_t& last_mark, const Edges& edges)
      : list_(list), ahead_mark_(last_mark + 1), behind_mark_(last_mark + 2), edges_(edges) {
    last_mark += 2;
  }

  /// Has `from` come before `to`. False, and nothing has changed, if there is a way from `to` to
  /// `from`.
  [[nodiscard]] bool Put(Node& from, Node& to) {
    if (from.place.IsBefore(to.place)) return true;
    std::vector<Node*> ahead{&to};
    std::vector<Node*> behind{&from};
    to.mark = ahead_mark_;
    from.mark = behind_mark_;
    std::size_t ahead_done = 0;
    std::size_t behind_done = 0;
    std::size_t ahead_work = edges_.Work(to);
    std::size_t behind_work = edges_.Work(from);
    for (;;) {
      if (ahead_work <= behind_work) {
        if (!LookAhead(*ahead[ahead_done++], from, ahead)) return false;
        if (ahead_done == ahead.size()) return MoveBehind(from, ahead), true;
        ahead_work += edges_.Work(*ahead[ahead_done]);
      } else {
        if (!LookBehind(*behind[behind_done++], to, behind)) return false;
        if (behind_done == behind.size()) return MoveBefore(to, behind), true;
        behind_work += edges_.Work(*behind[behind_done]);
      }
    }
  }

  /// All that can be reached from `to` without going past `from`, `to` among them.
  [[nodiscard]] std::vector<Node*> Reached(Node& from, Node& to) {
    std::vector<Node*> found{&to};
    to.mark = ahead_mark_;
    for (std::size_t i = 0; i < found.size(); ++i) {
      edges_.ForEachNext(*found[i], [&](Node& next) {
        const bool is_within = &next == &from || next.place.IsBefore(from.place);
        if (is_within && next.mark != ahead_mark_) Note(next, ahead_mark_, found);
      });
    }
    return found;
  }

  /// Puts `nodes` right behind `anchor`, in the order that they have.
  void MoveBehind(Node& anchor, std::vector<Node*> nodes) {
    SortByPlace(nodes);
    const Node* last = &anchor;
    for (Node* node : nodes) {
      list_.Remove(*node);
      list_.InsertAfter(*node, *last);
      last = node;
    }
  }

 private:
  static void Note(Node& node, std::uint64_t mark, std::vector<Node*>& found) {
    node.mark = mark;
    found.push_back(&node);
  }
  static void SortByPlace(std::vector<Node*>& nodes) {
    std::ranges::sort(nodes,
                      [](const Node* a, const Node* b) { return a->place.IsBefore(b->place); });
  }

  bool LookAhead(Node& node, const Node& from, std::vector<Node*>& ahead) {
    bool is_open = true;
    edges_.ForEachNext(node, [&](Node& next) {
      if (next.mark == behind_mark_) is_open = false;
      if (is_open && next.mark != ahead_mark_ && next.place.IsBefore(from.place)) {
        Note(next, ahead_mark_, ahead);
      }
    });
    return is_open;
  }

  bool LookBehind(Node& node, const Node& to, std::vector<Node*>& behind) {
    bool is_open = true;
    edges_.ForEachPrevious(node, [&](Node& previous) {
      if (previous.mark == ahead_mark_) is_open = false;
      if (is_open && previous.mark != behind_mark_ && to.place.IsBefore(previous.place)) {
        Note(previous, behind_mark_, behind);
      }
    });
    return is_open;
  }

  void MoveBefore(Node& anchor, std::vector<Node*> nodes) {
    SortByPlace(nodes);
    for (Node* node : nodes) {
      list_.Remove(*node);
      list_.InsertBefore(*node, anchor);
    }
  }

  BlockList<Node>& list_;
  const std::uint64_t ahead_mark_;
  const std::uint64_t behind_mark_;
  const Edges& edges_;
};

}  // namespace runnel::internal
