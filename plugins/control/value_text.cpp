#include "plugins/control/value_text.h"

#include <limits>
#include <string_view>

#include "core/types/text_format.h"

namespace runnel {

namespace {

void AppendQuoted(std::string_view text, std::string& to) {
  to += '"';
  for (const char character : text) {
    if (character == '"' || character == '\\') to += '\\';
    if (character == '\n') {
      to += "\\n";
    } else {
      to += character;
    }
  }
  to += '"';
}

// Not within a character of several bytes.
std::string Cut(std::string text, std::size_t longest) {
  if (text.size() <= longest) return text;
  while (longest > 0 && (text[longest] & 0xc0) == 0x80) --longest;
  return text.substr(0, longest) + "… " + std::to_string(text.size()) + " bytes in all";
}

class Writer {
 public:
  explicit Writer(const ValueTextOptions& options) : options_(options) {}

  void Write(const TypeInfo& type, void* value, bool is_inner) {
    if (text_.size() >= options_.all) {
      text_ += "…";
      return;
    }
    switch (type.kind()) {
      case TypeKind::kStructure:
        return WriteStructure(type, value);
      case TypeKind::kSequence:
        return WriteRow(type, value, 0);
      case TypeKind::kMatrix:
        return WriteMatrix(type, value);
      case TypeKind::kLeaf: {
        std::string text = Cut(ToText(type, value), options_.string);
        if (is_inner && type.leaf().needs_quotes) return AppendQuoted(text, text_);
        text_ += text;
        return;
      }
      default:
        text_ += ToText(type, value);
    }
  }
  std::string Take() { return std::move(text_); }

 private:
  void WriteStructure(const TypeInfo& type, void* value) {
    text_ += '{';
    const char* separator = "";
    for (const FieldInfo& field : type.fields()) {
      text_ += separator + field.name + ": ";
      Write(*field.type, field.address(value), true);
      separator = ", ";
    }
    text_ += '}';
  }
  void WriteRow(const TypeInfo& type, void* value, std::size_t row) {
    const ElementOperations& elements = type.elements();
    const std::size_t columns = elements.columns(value);
    WriteList(columns, [&](std::size_t i) {
      Write(*elements.type, elements.element(value, row * columns + i), true);
    });
  }
  void WriteMatrix(const TypeInfo& type, void* value) {
    WriteList(type.elements().rows(value), [&](std::size_t row) { WriteRow(type, value, row); });
  }
  template <typename WriteOne>
  void WriteList(std::size_t count, const WriteOne& write_one) {
    text_ += '[';
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) text_ += ", ";
      if (i >= options_.elements || text_.size() >= options_.all) {
        text_ += "… " + std::to_string(count) + " in all";
        break;
      }
      write_one(i);
    }
    text_ += ']';
  }

  const ValueTextOptions& options_;
  std::string text_;
};

}  // namespace

ValueTextOptions FullValueText() {
  constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
  return {.elements = kAny, .string = 4'000'000, .all = 4'000'000};
}

std::string ValueText(const TypeInfo& type, const void* value, const ValueTextOptions& options) {
  Writer writer(options);
  // The description gives a way to change the value, too; this only looks.
  writer.Write(type, const_cast<void*>(value), false);
  return writer.Take();
}

}  // namespace runnel
