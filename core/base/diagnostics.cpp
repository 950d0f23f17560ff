#include "core/base/diagnostics.h"

#include <algorithm>
#include <tuple>

namespace runnel {

namespace {

void AppendLines(std::vector<Error> entries, const std::string& kind, std::string& text) {
  std::stable_sort(entries.begin(), entries.end(), [](const Error& a, const Error& b) {
    return std::tie(a.position.file, a.position.line, a.position.column) <
           std::tie(b.position.file, b.position.line, b.position.column);
  });
  for (Error& entry : entries) {
    entry.message.insert(0, kind + (entry.path.empty() ? "" : entry.path + ": "));
    entry.path.clear();  // said inside the message, after the kind
    text += entry.ToString() + "\n";
  }
}

}  // namespace

std::string Diagnostics::ToString() const {
  std::string text;
  AppendLines(errors_, "error: ", text);
  AppendLines(warnings_, "warning: ", text);
  return text;
}

}  // namespace runnel
