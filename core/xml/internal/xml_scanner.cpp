#include <optional>
#include <utility>

#include "core/base/characters.h"
#include "core/xml/internal/text_checks.h"
#include "core/xml/internal/text_cursor.h"
#include "core/xml/internal/xml_node.h"

namespace runnel::internal {

namespace {

// Who goes through a tree calls itself for each level.
constexpr std::size_t kDeepestNesting = 90;

std::string Tag(const std::string& name) { return "<" + name + ">"; }

/// Each Take…() steps over one thing and returns false if it is not well-formed; error_ says why.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file_name) : cursor_(text, file_name) {}

  Result<std::unique_ptr<XmlNode>> Run() {
    if (cursor_.Sees("\xFF\xFE") || cursor_.Sees("\xFE\xFF")) {
      return Failure(cursor_.position(), "the file is UTF-16", "save it as UTF-8");
    }
    while (!cursor_.at_end()) {
      if (!TakeNext()) return std::move(*error_);
    }
    if (!root_) return Failure(cursor_.position(), "there is no element", "");
    if (!open_.empty()) {
      const XmlNode& last = *open_.back();
      return Failure(last.position, Tag(last.name) + " is never closed",
                     "add </" + last.name + ">");
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
      return Fail(cursor_.position(), "a document type declaration is not supported",
                  "leave it out");
    }
    if (cursor_.Sees("</")) return TakeEndTag();
    if (cursor_.Sees("<")) return TakeStartTag();
    return TakeText();
  }

  bool TakeDeclaration() {
    if (anything_but_declarations_) {
      return Fail(cursor_.position(), "'<?' must stand at the very beginning of the file", "");
    }
    const SourcePosition start = cursor_.position();
    const std::string_view rest = cursor_.rest();
    if (!TakePast("<?", "?>", "declaration")) return false;
    const std::string encoding = OtherEncoding(rest.substr(0, rest.find("?>")));
    if (!encoding.empty()) {
      return Fail(start, "the file says that it is " + encoding,
                  "save it as UTF-8 and write encoding=\"UTF-8\"");
    }
    cursor_.TakeSpace();
    return true;
  }

  bool TakeCharacterData() {
    if (open_.empty()) return FailOutside();
    NoteText();
    return TakePast("<![CDATA[", "]]>", "CDATA section", &open_.back()->text);
  }

  bool TakePast(std::string_view opening, std::string_view closing, const std::string& what,
                std::string* taken = nullptr) {
    const SourcePosition start = cursor_.position();
    cursor_.Take(opening.size());
    if (!TakeCharacters([&] { return cursor_.Sees(closing); }, Entities::kNone, taken)) {
      return false;
    }
    if (cursor_.at_end()) {
      return Fail(start, "a " + what + " that is never closed", "add " + std::string(closing));
    }
    cursor_.Take(closing.size());
    return true;
  }

  // White space that stands alone is no text.
  bool TakeText() {
    const TextCursor begin = cursor_;
    cursor_.TakeSpace();
    if (cursor_.at_end() || cursor_.next() == '<') return true;
    if (open_.empty()) return FailOutside();
    NoteText();
    cursor_ = begin;
    return TakeCharacters([&] { return cursor_.Sees("<"); }, Entities::kResolved,
                          &open_.back()->text);
  }

  void NoteText() {
    XmlNode& node = *open_.back();
    if (node.text_position.line == 0) node.text_position = cursor_.position();
  }

  bool TakeEndTag() {
    const SourcePosition start = cursor_.position();
    const std::size_t begin = cursor_.offset();
    cursor_.Take(2);
    std::string name;
    if (!TakeName(name)) return false;
    cursor_.TakeSpace();
    if (open_.empty()) return Fail(start, "</" + name + "> closes nothing", "");
    XmlNode& opened = *open_.back();
    if (name != opened.name) {
      return Fail(start,
                  "</" + name + "> where " + Tag(opened.name) + " of line " +
                      std::to_string(opened.position.line) + ", column " +
                      std::to_string(opened.position.column) + " is still open",
                  "write </" + opened.name + "> first");
    }
    if (cursor_.next() != '>') return Fail(start, "an end tag without '>'", "");
    cursor_.Take(1);
    opened.spans.end_tag = {begin, cursor_.offset()};
    Close();
    return true;
  }

  // What stands between its tags has been read.
  void Close() {
    XmlNode& node = *open_.back();
    node.spans.whole = {node.spans.start_tag.begin, node.spans.end_tag.end};
    node.text = Trimmed(node.text);
    if (node.text_position.line == 0) node.text_position = node.position;
    open_.pop_back();
  }

  bool TakeStartTag() {
    const SourcePosition start = cursor_.position();
    const std::size_t begin = cursor_.offset();
    cursor_.Take(1);
    auto made = std::make_unique<XmlNode>();
    XmlNode& node = *made;
    node.position = start;
    if (!TakeName(node.name)) return false;
    if (node.name.empty()) return Fail(start, "'<' without a name", "write &lt; for the character");
    if (open_.empty() && root_) {
      return Fail(start, "a second root element " + Tag(node.name), "a file has one");
    }
    if (open_.size() >= kDeepestNesting) return Fail(start, "elements nested too deeply", "");
    for (;;) {
      const bool is_spaced = !cursor_.TakeSpace().empty();
      if (cursor_.Sees(">") || cursor_.Sees("/>")) break;
      if (!TakeAttribute(node, is_spaced)) return false;
    }
    const bool closes = cursor_.Sees("/>");
    cursor_.Take(closes ? 2 : 1);
    node.spans.start_tag = {begin, cursor_.offset()};
    node.spans.end_tag = {cursor_.offset(), cursor_.offset()};
    Add(std::move(made));
    if (closes) Close();
    return true;
  }

  void Add(std::unique_ptr<XmlNode> made) {
    XmlNode* const node = made.get();
    if (open_.empty()) {
      root_ = std::move(made);
    } else {
      XmlNode& parent = *open_.back();
      node->parent = &parent;
      parent.owned_children.push_back(std::move(made));
      parent.children.emplace_back(*node);
    }
    open_.push_back(node);
  }

  /// `name` is empty if there is none.
  bool TakeName(std::string& name) {
    TextCursor characters = cursor_;
    name = cursor_.TakeName();
    for (std::size_t done = 0; done < name.size();) {
      const std::size_t length = FileCharacterLength(characters.rest());
      if (length == 0) return FailAtCharacter(characters);
      characters.Take(length);
      done += length;
    }
    return true;
  }

  bool TakeAttribute(XmlNode& node, bool is_spaced) {
    XmlAttribute attribute{.name = {},
                           .value = {},
                           .position = cursor_.position(),
                           .value_position = {},
                           .span = {cursor_.offset(), 0}};
    if (!TakeName(attribute.name)) return false;
    if (attribute.name.empty()) {
      return cursor_.at_end() || cursor_.next() == '<'
                 ? Fail(node.position, "the tag " + Tag(node.name) + " has no '>'", "")
                 : Fail(attribute.position, "an attribute must begin with a letter", "");
    }
    const std::string quoted = "'" + attribute.name + "'";
    if (!is_spaced) return Fail(attribute.position, "no space before attribute " + quoted, "");
    if (XmlElement(node).Attribute(attribute.name) != nullptr) {
      return Fail(attribute.position, "attribute " + quoted + " stands here twice",
                  "leave one out");
    }
    cursor_.TakeSpace();
    if (cursor_.next() != '=') {
      return Fail(attribute.position, "attribute " + quoted + " has no value", "");
    }
    cursor_.Take(1);
    cursor_.TakeSpace();
    if (!TakeValue(attribute, quoted)) return false;
    node.attributes.push_back(std::move(attribute));
    return true;
  }

  bool TakeValue(XmlAttribute& attribute, const std::string& quoted) {
    const char quote = cursor_.next();
    if (quote != '"' && quote != '\'') {
      return Fail(cursor_.position(), "the value of " + quoted + " is not in quotes",
                  "write \"…\" round it");
    }
    cursor_.Take(1);
    attribute.value_position = cursor_.position();
    attribute.value_span.begin = cursor_.offset();
    const auto at_stop = [&] { return cursor_.next() == quote || cursor_.next() == '<'; };
    if (!TakeCharacters(at_stop, Entities::kResolved, &attribute.value)) return false;
    if (cursor_.next() != quote) {
      return Fail(attribute.position, "the value of " + quoted + " has no closing quote",
                  cursor_.at_end() ? "" : "or write &lt; for '<' in it");
    }
    attribute.value_span.end = cursor_.offset();
    cursor_.Take(1);
    attribute.span.end = cursor_.offset();
    return true;
  }

  enum class Entities { kNone, kResolved };

  /// Steps on until `at_stop` or the end of the text. What it means goes to `taken`, if there is one; all ends
  /// of lines are one character there.
  template <typename Predicate>
  bool TakeCharacters(Predicate at_stop, Entities entities, std::string* taken) {
    while (!cursor_.at_end() && !at_stop()) {
      if (entities == Entities::kResolved && cursor_.next() == '&') {
        const auto length = ResolveEntity(cursor_.rest(), *taken);
        if (!length) {
          return Fail(cursor_.position(), length.error().message,
                      "write &amp; for the character '&'");
        }
        cursor_.Take(*length);
        continue;
      }
      const std::size_t length = FileCharacterLength(cursor_.rest());
      if (length == 0) return FailAtCharacter(cursor_);
      const std::string_view character = cursor_.Take(length);
      if (taken == nullptr) continue;
      if (character == "\r" && cursor_.next() == '\n') continue;
      *taken += character == "\r" ? "\n" : character;
    }
    return true;
  }

  bool FailAtCharacter(const TextCursor& at) {
    const std::string fault = UnwritableCharacter(at.rest().substr(0, 4));
    return Fail(at.position(), fault, fault.starts_with("byte") ? "save the file as UTF-8" : "");
  }
  bool FailOutside() { return Fail(cursor_.position(), "text outside of the root element", ""); }

  static Error Failure(SourcePosition position, std::string message, std::string hint) {
    return {
        .message = std::move(message), .position = std::move(position), .hint = std::move(hint)};
  }
  bool Fail(SourcePosition position, std::string message, std::string hint) {
    error_ = Failure(std::move(position), std::move(message), std::move(hint));
    return false;
  }

  TextCursor cursor_;
  std::unique_ptr<XmlNode> root_;
  std::vector<XmlNode*> open_;
  std::optional<Error> error_;
  bool anything_but_declarations_ = false;
};

}  // namespace

Result<std::unique_ptr<XmlNode>> ReadTree(std::string_view text, const std::string& file_name) {
  return Scanner(text, file_name).Run();
}

}  // namespace runnel::internal
