#include "core/xml/xml_document.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/base/folder_names.h"
#include "core/base/nearest_name.h"
#include "core/xml/internal/xml_node.h"

namespace runnel {

namespace {

constexpr std::size_t kLargestFile = std::size_t{64} << 20U;

Error CannotRead(const std::filesystem::path& path, std::string why, std::string hint = "") {
  return {.message = std::move(why), .position = {path.string()}, .hint = std::move(hint)};
}

std::string NearestFileHint(const std::filesystem::path& path) {
  const std::string nearest =
      NearestName(path.filename().string(), NamesInFolder(path.parent_path()));
  return nearest.empty() ? "" : "did you mean '" + nearest + "'?";
}

}  // namespace

const std::string& XmlElement::name() const noexcept { return node_->name; }

SourcePosition XmlElement::position() const { return node_->position; }

const ElementSpans& XmlElement::spans() const noexcept { return node_->spans; }

std::span<const XmlAttribute> XmlElement::attributes() const noexcept { return node_->attributes; }

std::span<const XmlElement> XmlElement::children() const noexcept { return node_->children; }

std::optional<XmlElement> XmlElement::parent() const {
  if (node_->parent == nullptr) return std::nullopt;
  return XmlElement(*node_->parent);
}

const std::string& XmlElement::text() const noexcept { return node_->text; }

SourcePosition XmlElement::text_position() const { return node_->text_position; }

const XmlAttribute* XmlElement::Attribute(std::string_view name) const noexcept {
  const auto found = std::ranges::find(node_->attributes, name, &XmlAttribute::name);
  return found == node_->attributes.end() ? nullptr : &*found;
}

XmlDocument::XmlDocument(std::unique_ptr<internal::XmlNode> root) noexcept
    : root_(std::move(root)) {}
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
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
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

Result<XmlDocument> XmlDocument::Parse(std::string_view text, const std::string& file_name) {
  auto root = internal::ReadTree(text, file_name);
  if (!root) return root.error();
  return XmlDocument(std::move(*root));
}

}  // namespace runnel
