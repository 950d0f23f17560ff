#pragma once

#include <string>

#include "plugins/genom_text/place.h"

namespace runnel::genom {

/// A token as the preprocessor sees it: what words and numbers mean is not known yet.
struct TextToken {
  enum class Kind { kEnd, kNewline, kWord, kNumber, kString, kCharacter, kMark, kStray, kPragma };

  Kind kind = Kind::kEnd;
  std::string text = {};  ///< as written; of a pragma, the rest of its line
  Place place = {};
  bool has_space_before = false;
  bool is_fixed = false;  ///< the name of a macro within its own expansion: stays as it is

  [[nodiscard]] bool Is(Kind wanted, const char* what) const { return kind == wanted && text == what; }
  [[nodiscard]] bool IsMark(const char* what) const { return Is(Kind::kMark, what); }
};

}  // namespace runnel::genom
