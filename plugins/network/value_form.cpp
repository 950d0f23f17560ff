#include "plugins/network/value_form.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_values.h"

namespace runnel {

namespace {

constexpr std::string_view kKey = "runnel_type=";
constexpr int kDeepest = 20;

void AppendDescription(const TypeInfo& type, int depth, std::string& text) {
  switch (type.kind()) {
    case TypeKind::kStructure:
      text += '{';
      for (const FieldInfo& field : type.fields()) {
        if (text.back() != '{') text += ',';
        text += field.name + ':';
        if (depth < kDeepest) AppendDescription(*field.type, depth + 1, text);
        if (!field.unit.empty()) text += '[' + field.unit + ']';
      }
      text += '}';
      return;
    case TypeKind::kEnumeration:
      text += '(';
      for (const EnumeratorInfo& each : type.enumerators()) {
        if (text.back() != '(') text += '|';
        text += each.name + '=' + std::to_string(each.value);
      }
      text += ')';
      return;
    case TypeKind::kSequence:
    case TypeKind::kMatrix:
      text += type.kind() == TypeKind::kMatrix ? "matrix<" : type.elements().is_fixed ? "array<" : "list<";
      AppendDescription(*type.elements().type, depth + 1, text);
      text += '>';
      return;
    case TypeKind::kLeaf:
    case TypeKind::kOpaque:
      text += type.name();
  }
}

// A name that DDS and its tools take: "runnel::msg::dds_::Pose2_".
std::string OwnWireType(const TypeInfo& type) {
  std::string name = type.name();
  const auto is_allowed = [](char each) {
    return (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') || (each >= '0' && each <= '9');
  };
  std::ranges::replace_if(name, [&](char each) { return !is_allowed(each); }, '_');
  return "runnel::msg::dds_::" + name + "_";
}

class OwnForm final : public ValueForm {
 public:
  explicit OwnForm(const TypeInfo& type) : type_(type) {
    wire_type_ = OwnWireType(type);
    user_data_ = std::string(kKey) + DescriptionText(type) + ";";
  }

  void Write(const void* value, Time, Octets& octets) const override {
    WriteCdr(type_, value, octets);
  }
  Result<void> Read(std::span<const std::byte> octets, void* value) const override {
    return ReadCdr(type_, octets, value);
  }

 private:
  const TypeInfo& type_;
};

std::string_view DescriptionIn(std::string_view user_data) {
  const std::size_t begin = user_data.find(kKey);
  if (begin == std::string_view::npos) return {};
  user_data.remove_prefix(begin + kKey.size());
  return user_data.substr(0, user_data.find(';'));
}

// From the beginning of the field in which the two differ, or of the whole.
std::string_view FieldAt(std::string_view text, std::size_t place) {
  std::size_t begin = text.find_last_of("{,", place);
  begin = begin == std::string_view::npos || begin == place ? std::min(place, text.size()) : begin + 1;
  return text.substr(begin, text.find_first_of(",}", begin) - begin);
}

}  // namespace

std::string DescriptionText(const TypeInfo& type) {
  std::string text;
  AppendDescription(type, 0, text);
  return text;
}

std::string TypeMisfit(const std::string& writers, const std::string& readers) {
  const std::string_view theirs = DescriptionIn(writers);
  const std::string_view ours = DescriptionIn(readers);
  if (theirs.empty() || ours.empty() || theirs == ours) return {};
  const auto differs = std::ranges::mismatch(theirs, ours).in1 - theirs.begin();
  const auto place = static_cast<std::size_t>(differs);
  const std::string_view its = FieldAt(theirs, place);
  const std::string_view own = FieldAt(ours, place);
  const auto quoted = [](std::string_view field) {
    return field.empty() ? std::string("nothing more") : "'" + std::string(field) + "'";
  };
  return "they are of two versions: the writer's has " + quoted(its) + " where the reader's has " + quoted(own);
}

Result<std::shared_ptr<const ValueForm>> ValueForm::Make(const TypeInfo& type, const std::string& as,
                                                         const std::string& /*frame*/) {
  if (!as.empty()) return Error{.message = "messages of ROS 2 are not known here: '" + as + "'"};
  if (auto checked = CheckCdr(type); !checked) return checked.error();
  return std::shared_ptr<const ValueForm>(std::make_shared<OwnForm>(type));
}

}  // namespace runnel
