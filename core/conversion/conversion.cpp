#include "core/conversion/conversion.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/nearest_name.h"
#include "core/conversion/number_conversion.h"
#include "core/types/builtin_types.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"

namespace runnel {

namespace {

struct ConversionRegistry {
  std::mutex mutex;
  std::vector<RegisteredConversion> all;
};

ConversionRegistry& Registered() {
  static ConversionRegistry registry;
  return registry;
}

std::optional<RegisteredConversion> FindRegistered(const TypeInfo& from, const TypeInfo& to, const std::string& name) {
  ConversionRegistry& registry = Registered();
  const std::lock_guard lock(registry.mutex);
  const auto found = std::ranges::find_if(registry.all, [&](const RegisteredConversion& each) {
    return each.from == &from && each.to == &to && (name.empty() ? each.is_usual : each.name == name);
  });
  return found == registry.all.end() ? std::nullopt : std::optional(*found);
}

// What can be done with a value, and how it is called.
struct Step {
  Conversion::Convert convert;
  std::string text;
};

struct Values {
  const TypeInfo& from;
  const TypeInfo& to;
  const std::string& name;
  const std::string& from_unit;
  const std::string& to_unit;
  [[nodiscard]] bool have_units() const { return !from_unit.empty() && !to_unit.empty() && from_unit != to_unit; }
};

Error Refusal(const Values& values, std::string hint = {}) {
  return {.message = "a " + values.from.name() + " does not become a " + values.to.name() +
                     (values.name.empty() ? " without saying how" : " by '" + values.name + "'"),
          .hint = std::move(hint)};
}

Result<Step> FindNumberStep(const Values& values) {
  const auto rounding = internal::RoundingCalled(values.name);
  const auto ratio = values.have_units() ? RatioOfUnits(values.from_unit, values.to_unit) : std::optional(UnitRatio{});
  if (!ratio) {
    return Error{.message = "what is in " + values.from_unit + " does not become something in " + values.to_unit};
  }
  const bool is_whole =
      internal::NothingIsLost(values.to, TypeOf<std::int64_t>()) || &values.to == &TypeOf<std::uint64_t>();
  const bool loses =
      !internal::NothingIsLost(values.from, values.to) || (ratio->numerator != ratio->denominator && is_whole);
  if (loses && !rounding) {
    return Error{
        .message = "a " + values.from.name() + " does not become a " + values.to.name() + " without losing something",
        .hint = "say how, by convert=\"round\" or convert=\"truncate\""};
  }
  std::string text = values.have_units() ? values.from_unit + " to " + values.to_unit : "";
  if (rounding && loses) text += (text.empty() ? "" : ", ") + values.name;
  return Step{internal::NumberConversion(values.from, values.to, rounding.value_or(internal::Rounding::kNone), *ratio),
              text};
}

Step CopyStep(const TypeInfo& type) {
  if (type.kind() == TypeKind::kLeaf) {
    return {[copy = type.leaf().copy](const void* from, void* to) {
              copy(to, from);
              return true;
            },
            {}};
  }
  return {[&type](const void* from, void* to) { return CopyValue(type, from, to); }, {}};
}

Result<Step> FindStep(const Values& values) {
  if (!values.name.empty()) {
    if (auto registered = FindRegistered(values.from, values.to, values.name)) {
      return Step{std::move(registered->convert), values.name};
    }
  }
  const bool are_numbers = internal::IsNumber(values.from) && internal::IsNumber(values.to);
  const bool is_plain = values.name.empty() || internal::RoundingCalled(values.name);
  if (are_numbers && is_plain) return FindNumberStep(values);
  if (values.name == "parse" && &values.from == &TypeOf<std::string>() && values.to.is_transparent()) {
    return Step{[&to = values.to](const void* from, void* value) {
                  return SetFromText(to, *static_cast<const std::string*>(from), value).has_value();
                },
                "parse"};
  }
  if (!values.name.empty()) {
    std::vector<std::string> names{"round", "truncate", "parse"};
    for (const RegisteredConversion& each : RegisteredConversions()) names.push_back(each.name);
    return Refusal(values, NearestNameHint(values.name, names));
  }
  if (&values.from == &values.to) {
    if (values.from.is_transparent()) return CopyStep(values.from);
    return Error{.message = "a " + values.from.name() + " cannot be copied"};
  }
  if (auto registered = FindRegistered(values.from, values.to, {})) {
    return Step{std::move(registered->convert), registered->name};
  }
  if (&values.to == &TypeOf<Signal>()) {
    return Step{[](const void*, void*) { return true; }, "signal"};
  }
  if (&values.to == &TypeOf<std::string>() && values.from.is_transparent()) {
    return Step{[&from = values.from](const void* value, void* text) {
                  *static_cast<std::string*>(text) = ToText(from, value);
                  return true;
                },
                "text"};
  }
  return Refusal(values);
}

std::string Joined(const std::string& part, const std::string& step) {
  return part.empty() || step.empty() ? part + step : part + ", " + step;
}

}  // namespace

Result<std::shared_ptr<const Conversion>> Conversion::Find(const ConversionRequest& request) {
  auto part = ValuePart::In(request.from, request.part);
  if (!part) return part.error();
  const std::string unit = part->is_whole() || part->unit().empty() ? request.from_unit : part->unit();
  auto step = FindStep({part->type(), request.to, request.name, unit, request.to_unit});
  if (!step) return step.error();
  auto conversion = std::make_shared<Conversion>();
  conversion->part_ = std::move(*part);
  conversion->convert_ = std::move(step->convert);
  conversion->text_ = Joined(request.part, step->text);
  return std::shared_ptr<const Conversion>(std::move(conversion));
}

std::shared_ptr<const Conversion> Conversion::Of(const TypeInfo& from, Convert convert) {
  auto conversion = std::make_shared<Conversion>();
  conversion->part_ = ValuePart::In(from, "").value();
  conversion->convert_ = std::move(convert);
  return conversion;
}

bool Conversion::operator()(const void* from, void* to) const noexcept {
  try {
    const void* const part = part_.Find(from);
    return part != nullptr && convert_(part, to);
  } catch (...) {
    return false;
  }
}

void RegisterConversion(RegisteredConversion conversion) {
  ConversionRegistry& registry = Registered();
  const std::lock_guard lock(registry.mutex);
  std::erase_if(registry.all, [&](const RegisteredConversion& each) {
    return each.name == conversion.name && each.from == conversion.from && each.to == conversion.to;
  });
  const auto place = std::ranges::upper_bound(registry.all, conversion.name, {}, &RegisteredConversion::name);
  registry.all.insert(place, std::move(conversion));
}

std::vector<RegisteredConversion> RegisteredConversions() {
  ConversionRegistry& registry = Registered();
  const std::lock_guard lock(registry.mutex);
  return registry.all;
}

std::string ConversionCandidate::text() const {
  std::string text;
  if (!part.empty()) text = "from=\"…" + std::string(part.starts_with('[') ? "" : ".") + part + "\"";
  if (!name.empty()) text += (text.empty() ? "" : " ") + ("convert=\"" + name + "\"");
  return text;
}

std::vector<ConversionCandidate> ConversionCandidates(const ConversionRequest& request, std::size_t most) {
  std::vector<ConversionCandidate> candidates;
  const auto try_one = [&](const std::string& part, const std::string& name) {
    if (candidates.size() >= most) return;
    ConversionRequest other = request;
    other.part = part;
    other.name = name;
    if (Conversion::Find(other)) candidates.push_back({part, name});
  };
  std::vector<std::string> names{"round"};
  for (const RegisteredConversion& each : RegisteredConversions()) {
    if (each.to == &request.to) names.push_back(each.name);
  }
  for (const std::string& name : names) try_one(request.part, name);
  if (request.part.empty()) {
    ForEachPart(request.from, [&](const std::string& part, const TypeInfo& type, const std::string&) {
      // What becomes a text or a signal does so as a whole, too.
      const bool are_numbers = internal::IsNumber(type) && internal::IsNumber(request.to);
      if (&type == &request.to || are_numbers) try_one(part, {});
    });
  }
  return candidates;
}

}  // namespace runnel
