#include "core/xml/xml_editor.h"

#include <algorithm>
#include <tuple>

#include "core/base/characters.h"
#include "core/xml/internal/xml_scanner.h"

namespace runnel {

namespace {

bool IsWhitespace(char character) { return character == ' ' || character == '\t'; }

std::string LineEndOf(std::string_view text) {
  const std::size_t end = text.find('\n');
  return end != std::string_view::npos && end > 0 && text[end - 1] == '\r' ? "\r\n" : "\n";
}

}  // namespace

XmlEditor::XmlEditor(const XmlDocument& document, std::string_view text) : text_(text) {
  layout_.line_end = LineEndOf(text);
  // What the first child is set in by, from its parent.
  for (const XmlElement child : document.root().children()) {
    const std::size_t begin = child.spans().whole.begin;
    const std::string outer = MarginAt(document.root().spans().whole.begin);
    const std::string inner = MarginAt(begin);
    if (!BeginsLine(begin) || inner.size() <= outer.size() || !inner.starts_with(outer)) continue;
    layout_.indent = inner.substr(outer.size());
    break;
  }
}

void XmlEditor::SetAttribute(XmlElement element, std::string_view name, std::string_view value) {
  if (const XmlAttribute* known = element.Attribute(name)) {
    if (known->value == value) return;
    const char quote = text_[known->value_span.begin - 1];
    Replace(known->value_span, EscapedAttribute(value, quote));
    return;
  }
  const std::size_t place = element.attributes().empty() ? element.spans().start_tag.begin + 1 + element.name().size()
                                                         : element.attributes().back().span.end;
  Insert(place, " " + std::string(name) + "=\"" + EscapedAttribute(value) + "\"");
}

void XmlEditor::RemoveAttribute(XmlElement element, std::string_view name) {
  const XmlAttribute* const known = element.Attribute(name);
  if (known == nullptr) return;
  std::size_t begin = known->span.begin;
  while (internal::IsXmlSpace(text_[begin - 1])) --begin;
  Cut({begin, known->span.end});
}

void XmlEditor::SetText(XmlElement element, std::string_view text) {
  if (element.text() == text) return;
  const ElementSpans& spans = element.spans();
  const std::string escaped = EscapedMarkup(text);
  if (spans.end_tag.size() == 0) {
    const std::size_t slash = spans.start_tag.end - 2;
    return Replace({slash, spans.start_tag.end}, ">" + escaped + "</" + element.name() + ">");
  }
  bool is_set = false;
  std::size_t place = spans.start_tag.end;
  while (place < spans.end_tag.begin) {
    constexpr std::string_view kComment = "<!--", kCommentEnd = "-->";
    if (text_.substr(place).starts_with(kComment)) {
      place = text_.find(kCommentEnd, place) + kCommentEnd.size();
      continue;
    }
    TextSpan piece{place, std::min(text_.find(kComment, place), spans.end_tag.begin)};
    place = piece.end;
    while (piece.size() > 0 && internal::IsXmlSpace(text_[piece.begin])) ++piece.begin;
    while (piece.size() > 0 && internal::IsXmlSpace(text_[piece.end - 1])) --piece.end;
    if (piece.size() == 0) continue;
    is_set ? Cut(piece) : Replace(piece, escaped);
    is_set = true;
  }
  if (!is_set) Insert(spans.end_tag.begin, escaped);
}

void XmlEditor::RemoveWords(const XmlAttribute& list, const std::set<std::size_t>& words) {
  std::size_t place = list.value_span.begin;
  const std::size_t end = list.value_span.end;
  const auto skip_space = [&] {
    while (place < end && internal::IsXmlSpace(text_[place])) ++place;
  };
  bool keeps_any = false;
  skip_space();
  for (std::size_t word = 0; place < end; ++word) {
    std::size_t begin = place;
    while (place < end && !internal::IsXmlSpace(text_[place])) ++place;
    const std::size_t word_end = place;
    skip_space();
    if (!words.contains(word)) {
      keeps_any = true;
      continue;
    }
    // With the whitespace before it; the first with that behind it.
    if (!keeps_any) {
      Cut({begin, place});
    } else {
      while (internal::IsXmlSpace(text_[begin - 1])) --begin;
      Cut({begin, word_end});
    }
  }
}

void XmlEditor::Remove(XmlElement element) {
  const TextSpan whole = element.spans().whole;
  const std::size_t before = SkipWhitespaceBack(whole.begin);
  const std::size_t behind = SkipWhitespace(whole.end);
  const std::size_t next_line = NextLine(whole.end);
  const bool is_last_of_line = next_line != whole.end;
  if (!is_last_of_line) {
    Cut({whole.begin, behind});
  } else {
    Cut({before, BeginsLine(whole.begin) ? next_line : whole.end});
  }
}

void XmlEditor::Append(XmlElement parent, NewElement element) {
  appended_.try_emplace(parent.spans().whole.begin, Appended{parent, {}})
      .first->second.elements.push_back(std::move(element));
}

void XmlEditor::InsertAfter(XmlElement sibling, const NewElement& element) {
  const TextSpan whole = sibling.spans().whole;
  InsertLines(whole.end, ElementText(element, MarginAt(whole.begin), layout_));
}

void XmlEditor::InsertFirst(XmlElement parent, const NewElement& element) {
  const TextSpan start = parent.spans().start_tag;
  if (parent.spans().end_tag.size() == 0) return Append(parent, element);
  InsertLines(start.end, ElementText(element, MarginInside(parent), layout_));
}

void XmlEditor::InsertLines(std::size_t place, std::string lines) {
  const std::size_t next_line = NextLine(place);
  if (next_line != place) return Insert(next_line, std::move(lines));
  lines.resize(lines.size() - layout_.line_end.size());
  Insert(place, layout_.line_end + lines);
}

std::string XmlEditor::Finish() {
  for (const auto& [place, appended] : appended_) WriteAppended(appended.parent, appended.elements);
  appended_.clear();
  std::vector<const Edit*> sorted;
  for (const Edit& edit : edits_) sorted.push_back(&edit);
  // What is put in before what is taken away from the same place on.
  std::ranges::stable_sort(sorted, {},
                           [](const Edit* edit) { return std::tuple(edit->span.begin, edit->span.size() > 0); });
  std::string result;
  std::size_t done = 0;
  for (const Edit* edit : sorted) {
    if (edit->span.begin >= done) {
      result += text_.substr(done, edit->span.begin - done);
      result += edit->text;
      done = edit->span.end;
    } else if (edit->text.empty()) {
      done = std::max(done, edit->span.end);
    }
  }
  return result += text_.substr(done);
}

void XmlEditor::WriteAppended(XmlElement parent, const std::vector<NewElement>& elements) {
  const ElementSpans& spans = parent.spans();
  const std::string margin = MarginInside(parent);
  std::string text;
  for (const NewElement& each : elements) text += ElementText(each, margin, layout_);
  const std::string outer = MarginAt(spans.whole.begin);
  if (spans.end_tag.size() == 0) {
    std::size_t begin = spans.start_tag.end - 2;
    while (internal::IsXmlSpace(text_[begin - 1])) --begin;
    Replace({begin, spans.start_tag.end}, ">" + layout_.line_end + text + outer + "</" + parent.name() + ">");
  } else if (BeginsLine(spans.end_tag.begin)) {
    Insert(SkipWhitespaceBack(spans.end_tag.begin), std::move(text));
  } else {
    Insert(spans.end_tag.begin, layout_.line_end + text + outer);
  }
}

std::string XmlEditor::MarginAt(std::size_t place) const {
  std::size_t begin = place;
  while (begin > 0 && text_[begin - 1] != '\n') --begin;
  if (begin == 0 && text_.starts_with("\xEF\xBB\xBF")) begin = 3;
  return std::string(text_.substr(begin, SkipWhitespace(begin) - begin));
}

std::string XmlEditor::MarginInside(XmlElement parent) const {
  const auto children = parent.children();
  for (std::size_t i = children.size(); i > 0; --i) {
    const std::size_t begin = children[i - 1].spans().whole.begin;
    if (BeginsLine(begin)) return MarginAt(begin);
  }
  return MarginAt(parent.spans().whole.begin) + layout_.indent;
}

std::size_t XmlEditor::SkipWhitespaceBack(std::size_t place) const {
  while (place > 0 && IsWhitespace(text_[place - 1])) --place;
  return place;
}

std::size_t XmlEditor::SkipWhitespace(std::size_t place) const {
  while (place < text_.size() && IsWhitespace(text_[place])) ++place;
  return place;
}

bool XmlEditor::BeginsLine(std::size_t place) const {
  const std::size_t before = SkipWhitespaceBack(place);
  return before == 0 || text_[before - 1] == '\n';
}

std::size_t XmlEditor::NextLine(std::size_t place) const {
  std::size_t end = SkipWhitespace(place);
  if (end < text_.size() && text_[end] == '\r') ++end;
  return end < text_.size() && text_[end] == '\n' ? end + 1 : place;
}

}  // namespace runnel
