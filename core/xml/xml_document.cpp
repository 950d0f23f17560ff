#include "core/xml/xml_document.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include <tinyxml2.h>

#include "core/base/folder_names.h"
#include "core/base/nearest_name.h"
#include "core/xml/internal/start_tags.h"
#include "core/xml/internal/text_cursor.h"

namespace runnel {

namespace internal {

/// Owns its children by pointer, so that nodes stay where they are while the tree grows and moves.
struct XmlNode {
  const std::string* file_name = nullptr;  // the root's own_file_name
  std::string own_file_name;               // at the root only
  std::string name;
  TextPlace place;
  ElementSpans spans;
  std::string text;
  TextPlace text_place;
  std::vector<XmlAttribute> attributes;
  const XmlNode* parent = nullptr;
  std::vector<std::unique_ptr<XmlNode>> owned_children;
  std::vector<XmlElement> children;
};

}  // namespace internal

namespace {

using internal::StartTag;
using internal::TextPlace;
using internal::XmlNode;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kLargestFile = std::size_t{64} << 20U;

std::string WithoutSpaceAtEnds(std::string_view text) {
  while (!text.empty() && internal::IsXmlSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && internal::IsXmlSpace(text.back())) text.remove_suffix(1);
  return std::string(text);
}

std::string TextOf(const tinyxml2::XMLElement& source) {
  std::string text;
  for (const auto* child = source.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (const tinyxml2::XMLText* piece = child->ToText()) text += piece->Value();
  }
  return WithoutSpaceAtEnds(text);
}

/// Joins what tinyxml2 read with the places of the start tags, both in the order of the file.
class TreeBuilder {
 public:
  TreeBuilder(const std::vector<StartTag>& tags, const std::string& file_name, std::size_t shift)
      : tags_(tags), file_name_(file_name), shift_(shift) {}

  /// nullptr if the two do not agree.
  std::unique_ptr<XmlNode> Build(const tinyxml2::XMLElement& root) {
    auto node = std::make_unique<XmlNode>();
    node->own_file_name = file_name_;
    node->file_name = &node->own_file_name;
    return Fill(*node, root) && next_ == tags_.size() ? std::move(node) : nullptr;
  }

 private:
  bool Fill(XmlNode& node, const tinyxml2::XMLElement& source) {
    if (next_ == tags_.size() || tags_[next_].name != source.Name()) return false;
    const StartTag& tag = tags_[next_++];
    node.name = tag.name;
    node.place = tag.place;
    node.spans = {Shifted({tag.span.begin, tag.end_tag.end}), Shifted(tag.span),
                  Shifted(tag.end_tag)};
    node.text = TextOf(source);
    node.text_place = tag.text_place.value_or(tag.place);
    if (!FillAttributes(node, source, tag)) return false;
    for (const auto* child = source.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      auto& added = *node.owned_children.emplace_back(std::make_unique<XmlNode>());
      added.file_name = node.file_name;
      added.parent = &node;
      if (!Fill(added, *child)) return false;
      node.children.emplace_back(added);
    }
    return true;
  }

  bool FillAttributes(XmlNode& node, const tinyxml2::XMLElement& source, const StartTag& tag) {
    const tinyxml2::XMLAttribute* attribute = source.FirstAttribute();
    for (const internal::AttributePlace& place : tag.attributes) {
      if (attribute == nullptr || place.name != attribute->Name()) return false;
      node.attributes.push_back({attribute->Name(), attribute->Value(), At(place.place),
                                 At(place.value_place), Shifted(place.span),
                                 Shifted(place.value_span)});
      attribute = attribute->Next();
    }
    return attribute == nullptr;
  }

  TextSpan Shifted(TextSpan span) const { return {span.begin + shift_, span.end + shift_}; }
  SourcePosition At(TextPlace place) const { return {file_name_, place.line, place.column}; }

  const std::vector<StartTag>& tags_;
  const std::string& file_name_;
  const std::size_t shift_;  // what stands before the text in its file
  std::size_t next_ = 0;
};

Error CannotRead(const std::filesystem::path& path, std::string why, std::string hint = "") {
  return {.message = std::move(why), .position = {path.string()}, .hint = std::move(hint)};
}

std::string NearestFileHint(const std::filesystem::path& path) {
  const std::string nearest =
      NearestName(path.filename().string(), NamesInFolder(path.parent_path()));
  return nearest.empty() ? "" : "did you mean '" + nearest + "'?";
}

Result<std::string> ReadFile(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    return CannotRead(path, "there is no such file", NearestFileHint(path));
  }
  if (std::filesystem::is_directory(status)) return CannotRead(path, "is a folder, not a file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return CannotRead(path, "cannot be opened", "may you read it?");
  std::string text;
  std::vector<char> block(std::size_t{1} << 16U);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestFile) return CannotRead(path, "is larger than 64 MiB");
  }
  if (stream.bad()) return CannotRead(path, "cannot be read");
  return text;
}

Result<void> RefuseOtherEncodings(std::string_view text, const std::string& file_name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return Error{
        .message = "the file is UTF-16", .position = {file_name, 1, 1}, .hint = "save it as UTF-8"};
  }
  return {};
}

}  // namespace

const std::string& XmlElement::name() const noexcept { return node_->name; }

SourcePosition XmlElement::position() const {
  return {*node_->file_name, node_->place.line, node_->place.column};
}

const ElementSpans& XmlElement::spans() const noexcept { return node_->spans; }

std::span<const XmlAttribute> XmlElement::attributes() const noexcept { return node_->attributes; }

std::span<const XmlElement> XmlElement::children() const noexcept { return node_->children; }

std::optional<XmlElement> XmlElement::parent() const {
  if (node_->parent == nullptr) return std::nullopt;
  return XmlElement(*node_->parent);
}

const std::string& XmlElement::text() const noexcept { return node_->text; }

SourcePosition XmlElement::text_position() const {
  return {*node_->file_name, node_->text_place.line, node_->text_place.column};
}

const XmlAttribute* XmlElement::Attribute(std::string_view name) const noexcept {
  const auto found = std::ranges::find(node_->attributes, name, &XmlAttribute::name);
  return found == node_->attributes.end() ? nullptr : &*found;
}

XmlDocument::XmlDocument(std::unique_ptr<XmlNode> root) noexcept : root_(std::move(root)) {}
XmlDocument::XmlDocument(XmlDocument&&) noexcept = default;
XmlDocument& XmlDocument::operator=(XmlDocument&&) noexcept = default;
XmlDocument::~XmlDocument() = default;

Result<std::string> XmlDocument::ReadText(const std::filesystem::path& path) {
  return ReadFile(path);
}

Result<XmlDocument> XmlDocument::Load(const std::filesystem::path& path) {
  const Result<std::string> text = ReadFile(path);
  if (!text) return text.error();
  return Parse(*text, path.string());
}

Result<XmlDocument> XmlDocument::Parse(std::string_view text, std::string file_name) {
  if (const auto encoding = RefuseOtherEncodings(text, file_name); !encoding) {
    return encoding.error();
  }
  const std::size_t shift = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  text.remove_prefix(shift);
  const auto tags = internal::FindStartTags(text, file_name);
  if (!tags) return tags.error();

  tinyxml2::XMLDocument source;
  if (source.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return Error{.message = std::string("not well-formed XML: ") + source.ErrorName(),
                 .position = {std::move(file_name), source.ErrorLineNum(), 0}};
  }
  auto root = TreeBuilder(*tags, file_name, shift).Build(*source.RootElement());
  if (!root) {
    return Error{.message = "not well-formed XML", .position = {std::move(file_name), 1, 1}};
  }
  return XmlDocument(std::move(root));
}

}  // namespace runnel
