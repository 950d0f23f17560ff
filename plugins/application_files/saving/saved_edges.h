#pragma once

#include <vector>

#include "core/port/port.h"

namespace runnel::internal {

/// The connections of an application, as far as a file has to say them: not those within a module,
/// nor those that lead out of the application.
///
/// Threads: under the structure lock.
class SavedEdges {
 public:
  explicit SavedEdges(FrameworkElement& application);

  struct Edge {
    Port* from;
    Port* to;
    ConnectOptions options;
    FrameworkElement* home;  ///< the innermost group that has both ends
    bool is_saved = false;   ///< a tag says it
  };

  /// nullptr if there is none.
  [[nodiscard]] Edge* Find(const Port& from, const Port& to);
  /// Those that no tag says yet, in the order in which they were made.
  [[nodiscard]] std::vector<Edge*> Unsaved();

 private:
  std::vector<Edge> edges_;
};

}  // namespace runnel::internal
