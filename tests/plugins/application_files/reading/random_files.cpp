#include "tests/plugins/application_files/reading/random_files.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

namespace runnel::testing {

namespace {

void Collect(XmlElement element, std::vector<XmlElement>& all) {
  all.push_back(element);
  for (const XmlElement child : element.children()) Collect(child, all);
}

std::string Piece(const std::string& text, TextSpan span) { return text.substr(span.begin, span.size()); }

std::string Repeated(std::string_view text, std::size_t count) {
  std::string all;
  for (; count > 0; --count) all += text;
  return all;
}

// Where a further child may be put: inside, or behind an element that has no inside.
std::size_t PlaceAt(XmlElement element) {
  const ElementSpans& spans = element.spans();
  return spans.end_tag.size() > 0 ? spans.start_tag.end : spans.whole.end;
}

// clang-format off
const std::vector<std::string> kStrangeValues = {
    "", " ", "-1", "0", "-0", "1e999", "-1e-999", "nan", "-inf", "1000000", "1000001",
    "2147483648", "4294967296", "18446744073709551616", "99999999999999999999999999999999999999",
    "0x10", "1,5", "1.", "+5", "true", "/", "//", "..", "../..", "../../../..", ".", "./.", "?",
    "a b", "a,b", "a/b", "/neighbour", "/neighbour/source", "/neighbour/source/value",
    "/neighbour/source/gain", "/neighbour/sink/value", "/neighbour/threads/main", "/drive/bad",
    "neighbour",
    "threads", "main", "threads/main", "&#10;", "&#9;x&#13;", "&#0;", "&#7;", "&#x10FFFF;",
    "&#x110000;", "&#xD800;", "&bogus;", "&amp;&lt;&quot;", "&", "<", "\"", "\xff", "\x01",
    "\xc3\xa9", "\xed\xa0\x80", "%20", "%s%n", "%", "50ms", "1e300s", "-5ms", "0ms", "1ns",
    "5 parsecs", "300000d", "app.xml", "wheel.xml", "brake.xml", "itself.xml", "broken.xml",
    "old_part.xml", "old_itself.xml", "missing.xml", "/dev/null", "{x: 1}", "[1, 2", "[[[[[[",
    "test/unready", "test/unmakeable", "test/optional", "test/", "/source", "int32", "double",
    "string"};
// clang-format on

}  // namespace

RandomFiles::RandomFiles(std::uint64_t seed, const std::filesystem::path& corpus) : seed_(seed) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    corpus_.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    const auto document = XmlDocument::Parse(corpus_.back(), file.string());
    if (document) NoteWords(document->root());
  }
}

void RandomFiles::NoteWords(XmlElement element) {
  tags_.push_back(element.name());
  for (const XmlAttribute& each : element.attributes()) {
    names_.push_back(each.name);
    values_.push_back(each.value);
  }
  for (const XmlElement child : element.children()) NoteWords(child);
}

std::string RandomFiles::Make(std::uint64_t number) {
  if (number < corpus_.size()) return corpus_[number];
  random_.seed(seed_ * 0x9E3779B97F4A7C15U + number);
  std::string text = OneOf(corpus_);
  for (std::size_t left = 1 + Below(5); left > 0; --left) {
    const auto document = XmlDocument::Parse(text, "");
    if (document && Below(12) != 0) {
      ChangeMarkup(text, *document);
    } else {
      Damage(text);
    }
  }
  return text;
}

void RandomFiles::ChangeMarkup(std::string& text, const XmlDocument& document) {
  std::vector<XmlElement> elements;
  Collect(document.root(), elements);
  Below(2) == 0 ? ChangeElement(text, elements) : ChangeAttribute(text, elements);
}

void RandomFiles::ChangeElement(std::string& text, const std::vector<XmlElement>& elements) {
  const XmlElement one = elements[Below(elements.size())];
  const XmlElement other = elements[Below(elements.size())];
  const TextSpan span = one.spans().whole;
  const std::string piece = Piece(text, span);
  switch (Below(9)) {
    case 0:  // away with it
      text.erase(span.begin, span.size());
      return;
    case 1:  // twice
      text.insert(PlaceAt(other), piece);
      return;
    case 2: {  // elsewhere
      const std::size_t place = PlaceAt(other);
      if (place > span.begin && place < span.end) return;
      text.insert(place, piece);
      text.erase(span.begin + (place <= span.begin ? piece.size() : 0), piece.size());
      return;
    }
    case 3: {  // swapped
      const TextSpan later = other.spans().whole;
      if (later.begin < span.end) return;
      const std::string second = Piece(text, later);
      text.replace(later.begin, later.size(), piece);
      text.replace(span.begin, span.size(), second);
      return;
    }
    case 4:
      return Rename(text, one);
    case 5: {  // one of another file
      const auto document = XmlDocument::Parse(OneOf(corpus_), "");
      if (!document) return;
      std::vector<XmlElement> foreign;
      Collect(document->root(), foreign);
      const XmlElement taken = foreign[Below(foreign.size())];
      std::string added = "<" + taken.name();
      for (const XmlAttribute& each : taken.attributes()) {
        added += " " + each.name + "='" + Misspelt(each.value) + "'";
      }
      text.insert(PlaceAt(one), added + "/>");
      return;
    }
    case 6:
      return Below(4) == 0 ? Nest(text, span) : void();
    case 7:  // only what is inside
      text.erase(one.spans().start_tag.end,
                 std::max(one.spans().end_tag.begin, one.spans().start_tag.end) - one.spans().start_tag.end);
      return;
    default:  // made anew, of known words
      text.insert(PlaceAt(one), "<" + OneOf(tags_) + " name=\"n" + std::to_string(Below(4)) + "\" " + OneOf(names_) +
                                    "=\"" + Value() + "\"/>");
  }
}

void RandomFiles::Rename(std::string& text, XmlElement element) {
  const std::string name = Below(2) == 0 ? OneOf(tags_) : Misspelt(element.name());
  const ElementSpans& spans = element.spans();
  const std::size_t length = element.name().size();
  if (spans.end_tag.size() > 0) text.replace(spans.end_tag.begin + 2, length, name);
  text.replace(spans.start_tag.begin + 1, length, name);
}

void RandomFiles::Nest(std::string& text, TextSpan span) {
  const std::string tag = Below(2) == 0 ? "group" : OneOf(tags_);
  const std::size_t depth = Below(3) == 0 ? 200 : 1 + Below(92);
  text.insert(span.end, Repeated("</" + tag + ">", depth));
  text.insert(span.begin, Repeated("<" + tag + " name=\"d\">", depth));
}

void RandomFiles::ChangeAttribute(std::string& text, const std::vector<XmlElement>& elements) {
  const XmlElement element = elements[Below(elements.size())];
  if (element.attributes().empty() || Below(6) == 0) {
    const std::size_t place = element.spans().start_tag.begin + 1 + element.name().size();
    text.insert(place, " " + OneOf(names_) + "=\"" + Value() + "\"");
    return;
  }
  const XmlAttribute& attribute = element.attributes()[Below(element.attributes().size())];
  const TextSpan span = attribute.value_span;
  switch (Below(8)) {
    case 0:
      text.erase(attribute.span.begin, attribute.span.size());
      return;
    case 1:
      text.replace(attribute.span.begin, attribute.name.size(),
                   Below(2) == 0 ? OneOf(names_) : Misspelt(attribute.name));
      return;
    case 2:
      text.replace(span.begin, span.size(), Misspelt(Piece(text, span)));
      return;
    case 3:  // a list grows
      text.insert(span.end, (Below(8) == 0 ? "\n" : " ") + Value());
      return;
    case 4: {  // what another has
      const XmlElement other = elements[Below(elements.size())];
      if (other.attributes().empty()) return;
      const auto& taken = other.attributes()[Below(other.attributes().size())];
      text.replace(span.begin, span.size(), Piece(text, taken.value_span));
      return;
    }
    default:
      text.replace(span.begin, span.size(), Value());
  }
}

std::string RandomFiles::Value() {
  switch (Below(16)) {
    case 0:
      return Misspelt(OneOf(values_));
    case 1:
      return OneOf(values_) + "/" + OneOf(values_);
    case 2:
      return std::to_string(random_());
    case 3:
      return Below(50) == 0 ? Repeated("x/", 3000) : std::string(Below(300), 'n');
    case 4:
    case 5:
    case 6:
    case 7:
    case 8:
      return OneOf(kStrangeValues);
    default:
      return OneOf(values_);
  }
}

std::string RandomFiles::Misspelt(std::string word) {
  if (word.empty() || Below(4) == 0) return word;
  const std::size_t at = Below(word.size());
  switch (Below(4)) {
    case 0:
      word.erase(at, 1);
      break;
    case 1:
      word.insert(at, 1, static_cast<char>('a' + Below(26)));
      break;
    case 2:
      std::swap(word[at], word[word.size() / 2]);
      break;
    default:
      word[at] = static_cast<char>(' ' + Below(95));
  }
  return word;
}

void RandomFiles::Damage(std::string& text) {
  const std::size_t at = Below(text.size() + 1);
  switch (Below(9)) {
    case 0:
      text.resize(at);
      break;
    case 1:
      text.insert(at, 1, static_cast<char>(Below(256)));
      break;
    case 2:
      if (at < text.size()) text[at] = static_cast<char>(Below(256));
      break;
    case 3:
      text.erase(at, 1 + Below(20));
      break;
    case 4:
      text.insert(at, text.substr(Below(text.size() + 1), Below(60)));
      break;
    case 5:
      text.insert(at, OneOf({"<!-- -- -->", "<!--", "<![CDATA[x]]>", "]]>", "<!DOCTYPE a>", "<?pi?>", "<", ">", "/>",
                             "</", "&#x", "&lt", "'", "\"", "=", "\r\n"}));
      break;
    case 6:
      text.insert(0, OneOf({"\xEF\xBB\xBF", "\xFF\xFE", "\xFE\xFF", "<?xml version='1.0'?>", " ",
                            "<?xml encoding='latin1'?>", "<a/>", "x", "<!-- -->"}));
      break;
    case 7: {
      std::string crossed;
      for (const char each : text) crossed += each == '\n' ? std::string("\r\n") : std::string(1, each);
      text = std::move(crossed);
      break;
    }
    default:
      text.insert(at, kStrangeValues[Below(kStrangeValues.size())]);
  }
}

}  // namespace runnel::testing
