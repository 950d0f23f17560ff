#include "core/xml/internal/xml_scanner.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/base/characters.h"

namespace runnel::internal {

namespace {

// tinyxml2 gives up at 100; staying below it, we are the one to say where.
constexpr std::size_t kDeepestNesting = 90;

std::string Quoted(std::string_view name) { return "<" + std::string(name) + ">"; }

std::string At(TextPlace place) {
  return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

constexpr std::array<std::string_view, 5> kNamedEntities{"amp", "lt", "gt", "quot", "apos"};
constexpr std::size_t kLongestEntity = 12;

bool IsXmlCharacter(std::uint32_t code) {
  if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
  return code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF) && code != 0xFFFE && code != 0xFFFF;
}

bool IsNumericEntity(std::string_view name) {
  if (!name.starts_with('#')) return false;
  const bool hexadecimal = name.starts_with("#x");
  name.remove_prefix(hexadecimal ? 2 : 1);
  std::uint32_t code = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), code, hexadecimal ? 16 : 10);
  return error == std::errc() && end == name.data() + name.size() && IsXmlCharacter(code);
}

// What is wrong with the entity that `text` begins with ("&lt;…"), "" if nothing is.
std::string EntityFault(std::string_view text) {
  text = text.substr(0, kLongestEntity);
  const auto is_of_name = [](char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '#';
  };
  const auto behind = std::find_if_not(text.begin() + 1, text.end(), is_of_name);
  const auto end = static_cast<std::size_t>(behind - text.begin());
  if (end == text.size() || text[end] != ';') return "'&' begins an entity that no ';' ends";
  const std::string_view name = text.substr(1, end - 1);
  if (std::ranges::find(kNamedEntities, name) != kNamedEntities.end()) return "";
  if (IsNumericEntity(name)) return "";
  return "no entity '" + std::string(text.substr(0, end + 1)) + "'";
}

// What a declaration ("<?xml version=… encoding=…") says of the encoding, "" if nothing.
std::string DeclaredEncoding(std::string_view declaration) {
  constexpr std::string_view kWord = "encoding";
  const std::size_t word = declaration.find(kWord);
  if (!declaration.starts_with("<?xml") || word == std::string_view::npos) return "";
  const std::size_t opening = declaration.find_first_of("\"'", word + kWord.size());
  if (opening == std::string_view::npos) return "";
  const std::string_view value = declaration.substr(opening + 1);
  return std::string(value.substr(0, value.find(declaration[opening])));
}

// Whether text of that encoding is UTF-8, as all ASCII is. "" stands for UTF-8.
bool IsReadableEncoding(std::string_view encoding) {
  std::string lower(encoding);
  for (char& character : lower) {
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
  }
  constexpr std::array<std::string_view, 5> kReadable{"", "utf-8", "utf8", "us-ascii", "ascii"};
  return std::ranges::find(kReadable, lower) != kReadable.end();
}

/// Each Take…() steps over one thing and returns false if it is not well-formed; error_ says why.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file_name, std::size_t begin)
      : file_name_(file_name), cursor_(text, begin) {}

  Result<std::unique_ptr<XmlNode>> Run() {
    while (!cursor_.at_end()) {
      if (!TakeNext()) return std::move(*error_);
    }
    if (!root_) return Failure(cursor_.place(), "there is no element", "");
    if (open_ != nullptr) {
      return Failure(open_->place, Quoted(open_->name) + " is never closed", "add </" + open_->name + ">");
    }
    return std::move(root_);
  }

 private:
  bool TakeNext() {
    if (cursor_.Sees("<?")) return TakeDeclaration();
    anything_but_declarations_ = true;
    if (cursor_.Sees("<!--")) return TakePast("<!--", "-->", "comment");
    if (cursor_.Sees("<![CDATA[")) return TakeCharacterData();
    if (cursor_.Sees("<!")) {
      return Fail(cursor_.place(), "a document type declaration is not supported", "leave it out");
    }
    if (cursor_.Sees("</")) return TakeEndTag();
    if (cursor_.Sees("<")) return TakeStartTag();
    return TakeText();
  }

  bool TakeDeclaration() {
    if (anything_but_declarations_) {
      return Fail(cursor_.place(), "'<?' must stand at the very beginning of the file", "");
    }
    const TextPlace start = cursor_.place();
    const std::string_view rest = cursor_.rest();
    if (!TakePast("<?", "?>", "declaration")) return false;
    const std::string encoding = DeclaredEncoding(rest.substr(0, rest.find("?>")));
    if (!IsReadableEncoding(encoding)) {
      return Fail(start, "the file says that it is " + encoding, "save it as UTF-8 and write encoding=\"UTF-8\"");
    }
    cursor_.SkipSpace();
    return true;
  }

  bool TakeCharacterData() {
    if (open_ == nullptr) return Fail(cursor_.place(), "text outside of the root element", "");
    NoteText();
    return TakePast("<![CDATA[", "]]>", "CDATA section");
  }

  bool TakePast(std::string_view opening, std::string_view closing, const std::string& what) {
    const TextPlace start = cursor_.place();
    cursor_.Take(opening.size());
    return TakeCharacters([&] { return cursor_.Sees(closing); }) && !cursor_.at_end()
               ? (cursor_.Take(closing.size()), true)
               : Fail(start, "a " + what + " that is never closed", "add " + std::string(closing));
  }

  bool TakeText() {
    const bool outside = open_ == nullptr;
    cursor_.SkipSpace();
    if (!outside && !cursor_.at_end() && cursor_.next() != '<') NoteText();
    if (outside && !cursor_.at_end() && cursor_.next() != '<') {
      return Fail(cursor_.place(), "text outside of the root element", "");
    }
    return TakeCharacters([&] { return cursor_.Sees("<"); }, /*check_entities=*/true);
  }

  void NoteText() {
    if (open_->text_place == open_->place) open_->text_place = cursor_.place();
  }

  bool TakeEndTag() {
    const TextPlace start = cursor_.place();
    const std::size_t begin = cursor_.offset();
    cursor_.Take(2);
    std::string_view name;
    if (!TakeName(name)) return false;
    cursor_.SkipSpace();
    if (open_ == nullptr) return Fail(start, "</" + std::string(name) + "> closes nothing", "");
    if (name != open_->name) {
      return Fail(
          start,
          "</" + std::string(name) + "> where " + Quoted(open_->name) + " of " + At(open_->place) + " is still open",
          "write </" + open_->name + "> first");
    }
    if (cursor_.next() != '>') return Fail(start, "an end tag without '>'", "");
    cursor_.Take(1);
    open_->spans.end_tag = {begin, cursor_.offset()};
    Close();
    return true;
  }

  bool TakeStartTag() {
    const TextPlace start = cursor_.place();
    const std::size_t begin = cursor_.offset();
    cursor_.Take(1);
    std::string_view name;
    if (!TakeName(name)) return false;
    if (name.empty()) return Fail(start, "'<' without a name", "write &lt; for the character");
    if (open_ == nullptr && root_) {
      return Fail(start, "a second root element " + Quoted(name), "a file has one");
    }
    if (depth_ >= kDeepestNesting) return Fail(start, "elements nested too deeply", "");
    XmlNode& node = Open(name, start);
    for (;;) {
      const bool spaced = cursor_.SkipSpace();
      if (cursor_.Sees(">") || cursor_.Sees("/>")) break;
      if (!TakeAttribute(node, spaced)) return false;
    }
    const bool closes = cursor_.Sees("/>");
    cursor_.Take(closes ? 2 : 1);
    node.spans.start_tag = {begin, cursor_.offset()};
    node.spans.end_tag = {cursor_.offset(), cursor_.offset()};
    if (closes) Close();
    return true;
  }

  XmlNode& Open(std::string_view name, TextPlace place) {
    auto made = std::make_unique<XmlNode>();
    XmlNode& node = *made;
    node.name = name;
    node.place = node.text_place = place;
    node.parent = open_;
    if (open_ != nullptr) {
      node.file_name = open_->file_name;
      open_->children.emplace_back(node);
      open_->owned_children.push_back(std::move(made));
    } else {
      node.own_file_name = file_name_;
      node.file_name = &node.own_file_name;
      root_ = std::move(made);
    }
    open_ = &node;
    ++depth_;
    return node;
  }
  void Close() {
    open_->spans.whole = {open_->spans.start_tag.begin, open_->spans.end_tag.end};
    open_ = open_->parent;
    --depth_;
  }

  /// `name` is empty if there is none.
  bool TakeName(std::string_view& name) {
    TextCursor characters = cursor_;
    name = cursor_.TakeName();
    for (std::size_t done = 0; done < name.size();) {
      const std::size_t length = FileCharacterLength(characters.rest());
      if (length == 0) {
        cursor_ = characters;
        return FailAtCharacter();
      }
      characters.Take(length);
      done += length;
    }
    return true;
  }

  bool TakeAttribute(XmlNode& node, bool spaced) {
    const TextPlace place = cursor_.place();
    const std::size_t begin = cursor_.offset();
    std::string_view name;
    if (!TakeName(name)) return false;
    if (name.empty()) {
      return cursor_.at_end() || cursor_.next() == '<'
                 ? Fail(node.place, "the tag " + Quoted(node.name) + " has no '>'", "")
                 : Fail(place, "an attribute must begin with a letter", "");
    }
    const std::string quoted = "'" + std::string(name) + "'";
    if (!spaced) return Fail(place, "no space before attribute " + quoted, "");
    if (std::ranges::count(node.attributes, name, &XmlAttribute::name) > 0) {
      return Fail(place, "attribute " + quoted + " stands here twice", "leave one out");
    }
    cursor_.SkipSpace();
    if (cursor_.next() != '=') return Fail(place, "attribute " + quoted + " has no value", "");
    cursor_.Take(1);
    cursor_.SkipSpace();
    XmlAttribute& attribute = node.attributes.emplace_back();
    attribute.name = name;
    attribute.position = PositionAt(place);
    attribute.span.begin = begin;
    return TakeValue(attribute, place, quoted);
  }

  bool TakeValue(XmlAttribute& attribute, TextPlace place, const std::string& quoted) {
    const char quote = cursor_.next();
    if (quote != '"' && quote != '\'') {
      return Fail(cursor_.place(), "the value of " + quoted + " is not in quotes", "write \"…\" round it");
    }
    cursor_.Take(1);
    attribute.value_position = PositionAt(cursor_.place());
    attribute.value_span.begin = cursor_.offset();
    const auto at_stop = [&] { return cursor_.next() == quote || cursor_.next() == '<'; };
    if (!TakeCharacters(at_stop, /*check_entities=*/true)) return false;
    if (cursor_.next() != quote) {
      return Fail(place, "the value of " + quoted + " has no closing quote",
                  cursor_.at_end() ? "" : "or write &lt; for '<' in it");
    }
    attribute.value_span.end = cursor_.offset();
    cursor_.Take(1);
    attribute.span.end = cursor_.offset();
    return true;
  }

  /// Steps on until `at_stop` or the end of the text.
  template <typename Predicate>
  bool TakeCharacters(Predicate at_stop, bool check_entities = false) {
    while (!cursor_.at_end() && !at_stop()) {
      const std::size_t length = FileCharacterLength(cursor_.rest());
      if (length == 0) return FailAtCharacter();
      if (check_entities && cursor_.next() == '&') {
        const std::string fault = EntityFault(cursor_.rest());
        if (!fault.empty()) {
          return Fail(cursor_.place(), fault, "write &amp; for the character '&'");
        }
      }
      cursor_.Take(length);
    }
    return true;
  }

  bool FailAtCharacter() {
    const std::string fault = UnwritableCharacter(cursor_.rest().substr(0, 4));
    return Fail(cursor_.place(), fault, fault.starts_with("byte") ? "save the file as UTF-8" : "");
  }

  SourcePosition PositionAt(TextPlace place) const { return {file_name_, place.line, place.column}; }
  Error Failure(TextPlace place, std::string message, std::string hint) const {
    return {.message = std::move(message), .position = PositionAt(place), .hint = std::move(hint)};
  }
  /// Keeps the first error only: what follows is mostly its consequence.
  bool Fail(TextPlace place, std::string message, std::string hint) {
    if (!error_) error_ = Failure(place, std::move(message), std::move(hint));
    return false;
  }

  const std::string& file_name_;
  TextCursor cursor_;
  std::unique_ptr<XmlNode> root_;
  XmlNode* open_ = nullptr;  // the innermost
  std::size_t depth_ = 0;    // of `open_`
  std::optional<Error> error_;
  bool anything_but_declarations_ = false;
};

}  // namespace

Result<std::unique_ptr<XmlNode>> ScanXml(std::string_view text, const std::string& file_name, std::size_t begin) {
  return Scanner(text, file_name, begin).Run();
}

}  // namespace runnel::internal
