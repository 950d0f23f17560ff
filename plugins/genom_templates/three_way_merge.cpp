#include "plugins/genom_templates/generated_files.h"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace runnel::genom {

namespace {

using Lines = std::vector<std::string_view>;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

Lines LinesOf(std::string_view text) {
  Lines lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return lines;
}

// For each line of `base`, where it is in `other`, by a longest common subsequence; kNone where it is not.
std::vector<std::size_t> Matches(const Lines& base, const Lines& other) {
  const std::size_t width = other.size() + 1;
  std::vector<std::uint32_t> longest((base.size() + 1) * width, 0);
  for (std::size_t i = base.size(); i-- > 0;) {
    for (std::size_t j = other.size(); j-- > 0;) {
      longest[i * width + j] = base[i] == other[j]
                                   ? longest[(i + 1) * width + j + 1] + 1
                                   : std::max(longest[(i + 1) * width + j], longest[i * width + j + 1]);
    }
  }
  std::vector<std::size_t> matches(base.size(), kNone);
  for (std::size_t i = 0, j = 0; i < base.size() && j < other.size();) {
    if (base[i] == other[j]) {
      matches[i++] = j++;
    } else if (longest[(i + 1) * width + j] >= longest[i * width + j + 1]) {
      ++i;
    } else {
      ++j;
    }
  }
  return matches;
}

Lines Part(const Lines& lines, std::size_t from, std::size_t to) {
  return {lines.begin() + static_cast<std::ptrdiff_t>(from), lines.begin() + static_cast<std::ptrdiff_t>(to)};
}

void Append(std::string& text, const Lines& lines) {
  for (const std::string_view each : lines) text += each;
}

void AppendWhole(std::string& text, const Lines& lines) {
  Append(text, lines);
  if (!lines.empty() && !text.ends_with('\n')) text += '\n';
}

void AppendConflict(Merged& merged, const Lines& mine, const Lines& made) {
  ++merged.conflicts;
  merged.text += "<<<<<<< yours\n";
  AppendWhole(merged.text, mine);
  merged.text += "=======\n";
  AppendWhole(merged.text, made);
  merged.text += ">>>>>>> template\n";
}

}  // namespace

Merged Merge(const std::string& base_text, const std::string& mine_text, const std::string& made_text) {
  const Lines base = LinesOf(base_text);
  const Lines mine = LinesOf(mine_text);
  const Lines made = LinesOf(made_text);
  const auto in_mine = Matches(base, mine);
  const auto in_made = Matches(base, made);
  Merged merged;
  std::size_t i = 0, a = 0, b = 0;
  while (i < base.size() || a < mine.size() || b < made.size()) {
    if (i < base.size() && in_mine[i] == a && in_made[i] == b) {
      merged.text += base[i];
      ++i, ++a, ++b;
      continue;
    }
    // Up to the next line that all three have.
    std::size_t next = i;
    while (next < base.size() && (in_mine[next] == kNone || in_made[next] == kNone)) ++next;
    const bool is_end = next == base.size();
    const std::size_t a_end = is_end ? mine.size() : in_mine[next];
    const std::size_t b_end = is_end ? made.size() : in_made[next];
    const Lines before = Part(base, i, next);
    const Lines of_mine = Part(mine, a, a_end);
    const Lines of_made = Part(made, b, b_end);
    if (of_mine == before || of_mine == of_made) {
      Append(merged.text, of_made);
    } else if (of_made == before) {
      Append(merged.text, of_mine);
    } else {
      AppendConflict(merged, of_mine, of_made);
    }
    i = next, a = a_end, b = b_end;
  }
  return merged;
}

}  // namespace runnel::genom
