#include "plugins/genom_text/place.h"

#include <algorithm>

namespace runnel::genom {

int Problems::FileIndex(const std::string& name) {
  const auto found = std::ranges::find(files_, name);
  if (found != files_.end()) return static_cast<int>(found - files_.begin());
  files_.push_back(name);
  return static_cast<int>(files_.size()) - 1;
}

SourcePosition Problems::PositionOf(Place place) const {
  if (place.file < 0) return {};
  return {FileName(place.file), place.line, place.column};
}

void Problems::Add(Place place, std::string message, std::string hint) {
  if (++count_ > kMost) return;
  diagnostics_.Add({.message = std::move(message), .position = PositionOf(place), .hint = std::move(hint)});
}

void Problems::Warn(Place place, std::string message, std::string hint) {
  if (diagnostics_.warnings().size() >= kMost) return;
  diagnostics_.AddWarning({.message = std::move(message), .position = PositionOf(place), .hint = std::move(hint)});
}

std::string Problems::DeclaredAt(Place place) const {
  if (place.file < 0) return "it is declared by the language";
  return "it is declared in " + FileName(place.file) + ":" + std::to_string(place.line) + ":" +
         std::to_string(place.column);
}

}  // namespace runnel::genom
