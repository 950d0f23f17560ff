#include "core/xml/text_edits.h"

#include <algorithm>
#include <tuple>

namespace runnel {

std::string TextEdits::Apply(std::string_view text) const {
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_) sorted.push_back(&edit);
  // What is put in before what is taken away from the same place on.
  std::ranges::stable_sort(sorted, {}, [](const Edit* edit) {
    return std::tuple(edit->span.begin, edit->span.size() > 0);
  });
  std::string result;
  std::size_t done = 0;
  for (const Edit* edit : sorted) {
    if (edit->span.begin >= done) {
      result += text.substr(done, edit->span.begin - done);
      result += edit->text;
      done = edit->span.end;
    } else if (edit->text.empty()) {
      done = std::max(done, edit->span.end);
    }
  }
  return result += text.substr(done);
}

}  // namespace runnel
