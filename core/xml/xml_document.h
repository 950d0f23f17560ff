#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/base/result.h"

namespace runnel {

/// A part of a text: the bytes from `begin` to before `end`.
struct TextSpan {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
  friend bool operator==(const TextSpan&, const TextSpan&) = default;
};

/// One attribute of an element. Entities in the value are resolved.
struct XmlAttribute {
  std::string name;
  std::string value;
  SourcePosition position;        ///< of the first character of the name
  SourcePosition value_position;  ///< of what follows the opening quote
  TextSpan span = {};             ///< from the name to the closing quote
  TextSpan value_span = {};       ///< between the quotes
};

/// Where an element stands in the bytes of its file.
struct ElementSpans {
  TextSpan whole;      ///< from the first "<" to the last ">"
  TextSpan start_tag;  ///< the same, if there is nothing but `<a/>`
  TextSpan end_tag;    ///< empty, at the end, for `<a/>`
};

namespace internal {
struct XmlNode;
}

/// An element of an XmlDocument: a handle as cheap as a pointer.
///
/// Lifetime: valid as long as the document, which may be moved meanwhile.
/// Threads:  a document never changes; any thread may read.
class XmlElement {
 public:
  explicit XmlElement(const internal::XmlNode& node) noexcept : node_(&node) {}

  [[nodiscard]] const std::string& name() const noexcept;
  /// Of the "<" that opens it. Columns count characters, not bytes; a tabulator is one.
  [[nodiscard]] SourcePosition position() const;
  /// For those who change a text and leave what they do not mean as it is (xml_editing.h).
  [[nodiscard]] const ElementSpans& spans() const noexcept;
  /// In the order of the file.
  [[nodiscard]] std::span<const XmlAttribute> attributes() const noexcept;
  [[nodiscard]] std::span<const XmlElement> children() const noexcept;
  /// Nothing at the root.
  [[nodiscard]] std::optional<XmlElement> parent() const;
  /// What stands directly between the tags, CDATA included, children and comments left out, without
  /// white space at either end.
  [[nodiscard]] const std::string& text() const noexcept;
  /// Of the first character of text(); position() if there is none.
  [[nodiscard]] SourcePosition text_position() const;

  /// nullptr if there is none of that name.
  [[nodiscard]] const XmlAttribute* Attribute(std::string_view name) const noexcept;
  /// What the attribute says; `otherwise` if there is none of that name.
  [[nodiscard]] std::string TextOr(std::string_view name, std::string_view otherwise = "") const;

  friend bool operator==(XmlElement, XmlElement) = default;

 private:
  const internal::XmlNode* node_;
};

/// A well-formed XML document, to be read only; every element and attribute knows its place.
///
/// Understood: UTF-8 with or without byte order mark, any line ends, comments, CDATA, the five
/// named entities and numeric ones. Refused: other encodings, document type declarations, control
/// characters, elements nested deeper than 90.
///
/// Errors: every error names the file and, unless the file could not be read, line and column.
class XmlDocument {
 public:
  /// Reads a file of at most 64 MiB.
  static Result<XmlDocument> Load(const std::filesystem::path& path);
  /// `file_name` is what errors call the text.
  static Result<XmlDocument> Parse(std::string_view text, std::string file_name);
  /// The bytes of a file that Load() would take.
  static Result<std::string> ReadText(const std::filesystem::path& path);

  XmlDocument(XmlDocument&&) noexcept;
  XmlDocument& operator=(XmlDocument&&) noexcept;
  ~XmlDocument();

  [[nodiscard]] XmlElement root() const noexcept { return XmlElement(*root_); }

 private:
  explicit XmlDocument(std::unique_ptr<internal::XmlNode> root) noexcept;

  std::unique_ptr<internal::XmlNode> root_;
};

}  // namespace runnel
