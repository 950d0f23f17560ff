#include "core/xml/xml_document.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include <tinyxml2.h>

#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "core/xml/internal/xml_scanner.h"

namespace runnel {

namespace {

using internal::XmlNode;

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::size_t kLargestFile = std::size_t{64} << 20U;

std::string TextOf(const tinyxml2::XMLElement& source) {
  std::string text;
  for (const auto* child = source.FirstChild(); child != nullptr; child = child->NextSibling()) {
    if (const tinyxml2::XMLText* piece = child->ToText()) text += piece->Value();
  }
  return std::string(internal::WithoutXmlSpace(text));
}

// Gives the elements what tinyxml2 has read of them. False if the two do not agree.
bool Fill(XmlNode& node, const tinyxml2::XMLElement& source) {
  if (node.name != source.Name()) return false;
  node.text = TextOf(source);
  const tinyxml2::XMLAttribute* attribute = source.FirstAttribute();
  for (XmlAttribute& each : node.attributes) {
    if (attribute == nullptr || each.name != attribute->Name()) return false;
    each.value = attribute->Value();
    attribute = attribute->Next();
  }
  const tinyxml2::XMLElement* child = source.FirstChildElement();
  for (const auto& each : node.owned_children) {
    if (child == nullptr || !Fill(*each, *child)) return false;
    child = child->NextSiblingElement();
  }
  return attribute == nullptr && child == nullptr;
}

Error CannotRead(const std::filesystem::path& path, std::string why, std::string hint = "") {
  return {.message = std::move(why), .position = {path.string()}, .hint = std::move(hint)};
}

std::string NearestFileHint(const std::filesystem::path& path) {
  const std::string nearest = NearestName(path.filename().string(), NamesInFolder(path.parent_path()));
  return nearest.empty() ? "" : "did you mean '" + nearest + "'?";
}

}  // namespace

const std::string& XmlElement::name() const noexcept { return node_->name; }

SourcePosition XmlElement::position() const { return {*node_->file_name, node_->place.line, node_->place.column}; }

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
std::string XmlElement::TextOr(std::string_view name, std::string_view otherwise) const {
  const XmlAttribute* const found = Attribute(name);
  return found != nullptr ? found->value : std::string(otherwise);
}

XmlDocument::XmlDocument(std::unique_ptr<XmlNode> root) noexcept : root_(std::move(root)) {}
XmlDocument::XmlDocument(XmlDocument&&) noexcept = default;
XmlDocument& XmlDocument::operator=(XmlDocument&&) noexcept = default;
XmlDocument::~XmlDocument() = default;

Result<std::string> XmlDocument::ReadText(const std::filesystem::path& path) {
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
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestFile) return CannotRead(path, "is larger than 64 MiB");
  }
  if (stream.bad()) return CannotRead(path, "cannot be read");
  return text;
}

Result<XmlDocument> XmlDocument::Load(const std::filesystem::path& path) {
  const Result<std::string> text = ReadText(path);
  if (!text) return text.error();
  return Parse(*text, path.string());
}

Result<XmlDocument> XmlDocument::Parse(std::string_view text, std::string file_name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    return Error{.message = "the file is UTF-16", .position = {file_name, 1, 1}, .hint = "save it as UTF-8"};
  }
  const std::size_t shift = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  text.remove_prefix(shift);
  auto root = internal::ScanXml(text, file_name, shift);
  if (!root) return root.error();

  tinyxml2::XMLDocument source;
  if (source.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return Error{.message = std::string("not well-formed XML: ") + source.ErrorName(),
                 .position = {std::move(file_name), source.ErrorLineNum(), 0}};
  }
  if (!Fill(**root, *source.RootElement())) {
    return Error{.message = "not well-formed XML", .position = {std::move(file_name), 1, 1}};
  }
  return XmlDocument(std::move(*root));
}

}  // namespace runnel
