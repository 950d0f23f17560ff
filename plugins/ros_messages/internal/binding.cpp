#include "plugins/ros_messages/internal/binding.h"

#include <algorithm>
#include <set>
#include <utility>

#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_messages/internal/message_leaf.h"

namespace runnel::internal {

namespace {

using Kind = Step::Kind;

constexpr int kDeepest = 50;
bool IsNumber(const TypeInfo& type) {
  const MessageField field = IsLeaf(type) ? FieldOfLeaf(type) : MessageField{.name = {}, .type = MessageType::kNested};
  return SizeOf(field.type) > 0;
}

std::string TypeTextOf(const MessageField& field) {
  std::string text = field.type == MessageType::kNested ? field.nested : std::string(NameOf(field.type));
  if (field.count == MessageCount::kArray) return text + "[" + std::to_string(field.capacity) + "]";
  return field.count == MessageCount::kOne ? text : text + "[]";
}

const MappingRule* FindRule(std::string_view message, const std::string& field) {
  const auto* const found = std::ranges::find_if(
      kMappingRules, [&](const MappingRule& each) { return each.message == message && each.field == field; });
  return found == std::end(kMappingRules) ? nullptr : found;
}

bool HasRulesWithin(std::string_view message, const std::string& prefix) {
  return std::ranges::any_of(kMappingRules, [&](const MappingRule& each) {
    return each.message == message && each.field.starts_with(prefix);
  });
}

/// Builds the steps from the message's side.
class Binder {
 public:
  Binder(const TypeInfo& type, const MessageOptions& options, const MessageLibrary& library)
      : root_(type), options_(options), library_(library) {}

  Result<Binding> Bind(const MessageDefinition& definition) {
    Place place{.owner = &definition, .type = &root_, .is_root = true};
    auto root = Structure(definition, place);
    if (!root) return root.error();
    if (bound_ == 0 && !(definition.fields.empty() && &root_ == &TypeOf<Signal>())) {
      return Error{.message = "a " + root_.name() + " has nothing of a " + definition.name,
                   .hint = HintFor(definition)};
    }
    Binding binding{.root = std::move(*root), .left_out = {}, .why_no_decoding = why_no_decoding_};
    for (const FieldInfo& field : root_.fields()) {
      if (!used_.contains(&field)) binding.left_out.push_back(field.name);
    }
    return binding;
  }

  Result<Binding> BindPart(const MessageField& field) {
    auto root = Part(field, root_);
    if (!root) return root.error();
    return Binding{.root = std::move(*root), .left_out = {}, .why_no_decoding = why_no_decoding_};
  }

 private:
  // What of the value stands beside the fields of a message.
  struct Place {
    const MessageDefinition* owner;  // whose rules count
    const TypeInfo* type;            // nullptr: nothing of the value
    std::string prefix = {};         // of the rules of the owner
    bool is_root = false;
  };

  Result<Step> Structure(const MessageDefinition& definition, const Place& place) {
    if (++depth_ > kDeepest) return Error{.message = "the message '" + definition.name + "' is nested too deep"};
    Step step{.kind = Kind::kStructure, .part = place.type};
    for (const MessageField& field : definition.fields) {
      auto inside = Field(definition, field, place);
      if (!inside) return inside.error();
      inside->name = field.name;
      step.inside.push_back(std::move(*inside));
    }
    if (definition.fields.empty()) step.inside.push_back(NumberStep(MessageType::kUint8, 0));
    --depth_;
    return step;
  }

  Result<Step> Field(const MessageDefinition& definition, const MessageField& field, const Place& place) {
    const TypeInfo* const type = place.type;
    if (type != nullptr && place.prefix.empty()) {
      if (const FieldInfo* const same = type->FindField(field.name)) return PartOf(field, *same);
    }
    if (type != nullptr) {
      if (const auto* const rule = FindRule(place.owner->name, place.prefix + field.name)) {
        return ByRule(*rule, field, place);
      }
    }
    if (field.count == MessageCount::kOne && field.type == MessageType::kNested) {
      if (field.nested == kHeaderMessage && field.name == "header") return HeaderStep(place.is_root, options_.frame);
      const bool is_stamp = field.nested == kTimeMessage && field.name == "stamp";
      if (is_stamp && (place.is_root || type == nullptr)) return StampStep(place.is_root);
    }
    if (type == nullptr) return DefaultStep(field, library_);
    const auto is_content = [](const MessageField& each) { return each.nested != kHeaderMessage; };
    const bool is_alone = is_content(field) && std::ranges::count_if(definition.fields, is_content) == 1;
    const bool is_structure = type->kind() == TypeKind::kStructure;
    if (is_alone && (!is_structure || field.type == MessageType::kNested)) return Itself(field, *type);
    if (!is_structure && field.name == "data" && place.prefix.empty()) return Itself(field, *type);
    const std::string within = place.prefix + field.name + ".";
    if (field.type == MessageType::kNested && field.count == MessageCount::kOne &&
        HasRulesWithin(place.owner->name, within)) {
      const auto nested = library_.Get(field.nested);
      if (!nested) return nested.error();
      return Structure(**nested, {.owner = place.owner, .type = type, .prefix = within});
    }
    return DefaultStep(field, library_);
  }

  Result<Step> ByRule(const MappingRule& rule, const MessageField& field, const Place& place) {
    const TypeInfo& type = *place.type;
    if (rule.source == kChildFrame) return TextStep(options_.child_frame);
    if (rule.source == kItself) return Itself(field, type);
    if (rule.source == kInListOfOne) {
      auto element = Itself(One(field), type);
      if (!element || element->part == nullptr) return element ? DefaultStep(field, library_) : element;
      why_no_decoding_ = "a " + place.owner->name + " has any number of " + field.name + ", of which a " +
                         root_.name() + " would be one";
      return Step{.kind = Kind::kListOfOne, .inside = {std::move(*element)}};
    }
    if (rule.source == kHeadingOf) {
      const FieldInfo* const heading = type.FindField("heading");
      if (heading == nullptr || !IsNumber(*heading->type)) return DefaultStep(field, library_);
      return Used(Kind::kHeading, heading, *heading->type);
    }
    if (rule.source == kLastAngleOf) {
      const FieldInfo *const ranges = type.FindField("ranges"), *const first = type.FindField("start_angle"),
                             *const step_of = type.FindField("angle_step");
      const bool has_all = ranges != nullptr && IsElements(*ranges->type) && first != nullptr &&
                           IsNumber(*first->type) && step_of != nullptr && IsNumber(*step_of->type);
      if (!has_all) return DefaultStep(field, library_);
      return Step{.kind = Kind::kLastAngle, .type = field.type, .part = &type};
    }
    const FieldInfo* const source = type.FindField(rule.source);
    if (source == nullptr) return DefaultStep(field, library_);
    return PartOf(field, *source);
  }

  Result<Step> PartOf(const MessageField& field, const FieldInfo& source) {
    auto step = Part(field, *source.type);
    if (!step) return step.error().WithContext(source.name);
    step->field = &source;
    used_.insert(&source);
    return step;
  }

  // The value itself, or nothing of it if that does not fit.
  Result<Step> Itself(const MessageField& field, const TypeInfo& type) {
    const int before = bound_;
    const int depth = depth_;
    auto step = Part(field, type);
    if (step && bound_ > before) return step;
    bound_ = before;
    depth_ = depth;
    return DefaultStep(field, library_);
  }

  Result<Step> Part(const MessageField& field, const TypeInfo& type) {
    if (auto checked = CheckCdr(type); !checked) return checked.error();
    if (IsSame(field, type, library_)) return Used(Kind::kPlain, nullptr, type);
    if (field.count != MessageCount::kOne) return Elements(field, type);
    if (SizeOf(field.type) > 0 && IsNumber(type)) {
      Step step = Used(Kind::kNumber, nullptr, type);
      step.type = field.type;
      return step;
    }
    if (field.type == MessageType::kNested) {
      const auto nested = library_.Get(field.nested);
      if (!nested) return nested.error();
      const int before = bound_;
      auto step = Structure(**nested, {.owner = *nested, .type = &type});
      if (!step || bound_ > before) return step;
    }
    return Mismatch(field, type);
  }

  Result<Step> Elements(const MessageField& field, const TypeInfo& type) {
    if (!IsElements(type)) return Mismatch(field, type);
    const ElementOperations& elements = type.elements();
    if (type.kind() == TypeKind::kMatrix && !elements.is_fixed) return Mismatch(field, type);
    const bool is_array = field.count == MessageCount::kArray;
    if (is_array && elements.is_fixed && FixedCount(type) != field.capacity) return Mismatch(field, type);
    auto element = Part(One(field), *elements.type);
    if (!element) return element;
    auto nothing = DefaultStep(One(field), library_);
    if (!nothing) return nothing;
    Step step = Used(Kind::kElements, nullptr, type);
    step.count = field.count;
    step.capacity = field.capacity;
    step.inside.push_back(std::move(*element));
    step.element.push_back(std::move(*nothing));
    return step;
  }

  static Error Mismatch(const MessageField& field, const TypeInfo& type) {
    return {.message = "a " + type.name() + " is no " + TypeTextOf(field),
            .hint = "write a .msg of the type's own description with 'runnel export ros2', or choose another message"};
  }

  Step Used(Kind kind, const FieldInfo* field, const TypeInfo& type) {
    ++bound_;
    if (field != nullptr) used_.insert(field);
    return {.kind = kind, .field = field, .part = &type};
  }

  std::string HintFor(const MessageDefinition& definition) const {
    for (const DefaultMessage& each : kDefaultMessages) {
      if (each.semantic_tag == root_.semantic_tag() && each.message != definition.name) {
        return "what fits is " + std::string(each.message);
      }
    }
    return "its fields are " + [&] {
      std::string names;
      for (const MessageField& field : definition.fields) names += (names.empty() ? "" : ", ") + field.name;
      return names;
    }();
  }

  const TypeInfo& root_;
  const MessageOptions& options_;
  const MessageLibrary& library_;
  std::set<const FieldInfo*> used_;
  int bound_ = 0;
  int depth_ = 0;
  std::string why_no_decoding_;
};

}  // namespace

Result<Binding> Bind(const MessageDefinition& definition, const TypeInfo& type, const MessageOptions& options,
                     const MessageLibrary& library) {
  return Binder(type, options, library).Bind(definition);
}

Result<Binding> BindPart(const MessageField& field, const TypeInfo& type, const MessageOptions& options,
                         const MessageLibrary& library) {
  return Binder(type, options, library).BindPart(field);
}

}  // namespace runnel::internal
