#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/base/number_text.h"
#include "plugins/ros_messages/internal/binding.h"

namespace runnel::internal {

namespace {

std::vector<std::string> FieldsOf(const MessageDefinition& definition) {
  return NamesOf(definition.fields, &MessageField::name);
}

/// Follows the name of a field, and notes what is to be passed over on the way there.
class FieldBinder {
 public:
  FieldBinder(const TypeInfo& type, const MessageOptions& options, const MessageLibrary& library)
      : type_(type), options_(options), library_(library) {}

  Result<Binding> Bind(const MessageDefinition& definition) {
    auto way = Within(definition, options_.field);
    if (!way) return way.error();
    Binding binding{.root = {}, .left_out = {}, .why_no_decoding = std::move(why_no_decoding_)};
    binding.root.inside.push_back(std::move(*way));  // as one thing, of which nothing may be missing at the end
    return binding;
  }

 private:
  Result<Step> Within(const MessageDefinition& definition, std::string_view name) {
    const std::size_t end = std::min(name.find_first_of(".["), name.size());
    const std::string first(name.substr(0, end));
    const MessageField* const field = definition.FindField(first);
    if (field == nullptr) {
      return Error{.message = definition.name + " has no field '" + first + "'",
                   .hint = NearestNameHint(first, FieldsOf(definition))};
    }
    Step step;
    for (const MessageField& each : definition.fields) {
      auto inside = &each == field ? Of(each, name.substr(end)) : DefaultStep(each, library_);
      if (!inside) return inside.error();
      inside->name = each.name;
      step.inside.push_back(std::move(*inside));
      if (&each == field) break;
    }
    return step;
  }

  // What `rest` says behind the name of the field.
  Result<Step> Of(const MessageField& field, std::string_view rest) {
    if (rest.empty()) return Itself(field);
    if (rest.starts_with('[')) return Element(field, rest);
    if (rest.starts_with('.')) rest.remove_prefix(1);
    if (field.count != MessageCount::kOne) {
      return Error{.message = "'" + field.name + "' is a list", .hint = "say which of its elements: " + field.name + "[0]." + std::string(rest)};
    }
    if (field.type != MessageType::kNested) return Error{.message = "'" + field.name + "' has no fields"};
    const auto nested = library_.Get(field.nested);
    return nested ? Within(**nested, rest) : nested.error();
  }

  Result<Step> Element(const MessageField& field, std::string_view rest) {
    if (field.count == MessageCount::kOne) return Error{.message = "'" + field.name + "' has no elements"};
    const std::size_t end = rest.find(']');
    const auto index = end == std::string_view::npos ? std::nullopt : NumberIn<std::size_t>(std::string(rest.substr(1, end - 1)));
    if (!index) return Error{.message = "'" + std::string(rest) + "' names no element", .hint = "write [INDEX], counted from 0"};
    if (field.count != MessageCount::kList && *index >= field.capacity) {
      return Error{.message = "'" + field.name + "' has no element [" + std::to_string(*index) + "]",
                   .hint = "it has " + std::to_string(field.capacity) + (field.count == MessageCount::kArray ? "" : " at most") + ", counted from 0"};
    }
    auto inside = Of(One(field), rest.substr(end + 1));
    if (!inside) return inside;
    auto before = DefaultStep(One(field), library_);
    if (!before) return before;
    Step step{.kind = Step::Kind::kElement, .count = field.count, .capacity = field.capacity, .index = *index};
    step.inside.push_back(std::move(*inside));
    step.element.push_back(std::move(*before));
    return step;
  }

  Result<Step> Itself(const MessageField& field) {
    auto bound = BindPart(field, type_, options_, library_);
    if (bound) {
      why_no_decoding_ = std::move(bound->why_no_decoding);
      return std::move(bound->root);
    }
    Error error = bound.error();
    error.message = "field '" + options_.field + "': " + error.message;
    error.hint = "choose another field, or an input of its type";
    if (field.count != MessageCount::kOne) error.hint = "of its elements, the first is " + options_.field + "[0]";
    const MessageDefinition* const nested = field.count == MessageCount::kOne ? library_.Find(field.nested) : nullptr;
    if (nested != nullptr) {
      error.hint = "say which of its fields:";
      for (const std::string& each : FieldsOf(*nested)) error.hint += " " + options_.field + "." + each;
    }
    return error;
  }

  const TypeInfo& type_;
  const MessageOptions& options_;
  const MessageLibrary& library_;
  std::string why_no_decoding_;
};

}  // namespace

Result<Binding> BindField(const MessageDefinition& definition, const TypeInfo& type, const MessageOptions& options,
                          const MessageLibrary& library) {
  return FieldBinder(type, options, library).Bind(definition);
}

}  // namespace runnel::internal
