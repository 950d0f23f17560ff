#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/xml/xml_document.h"

namespace runnel {

/// Changes to a text that leave all the rest of it as it is, byte for byte. Places are those of the
/// text before any change.
class TextEdits {
 public:
  /// What is put at one place goes there in the order of the calls.
  void Insert(std::size_t place, std::string text) { Replace({place, place}, std::move(text)); }
  void Cut(TextSpan span) { Replace(span, ""); }
  /// Of two that overlap, the later in the text gives way; what both cut is cut.
  void Replace(TextSpan span, std::string text) { edits_.push_back({span, std::move(text)}); }

  [[nodiscard]] bool empty() const noexcept { return edits_.empty(); }
  /// Precondition: all places are within `text`.
  [[nodiscard]] std::string Apply(std::string_view text) const;

 private:
  struct Edit {
    TextSpan span;
    std::string text;
  };
  std::vector<Edit> edits_;
};

}  // namespace runnel
