#include "plugins/inspector/internal/conversion_request.h"

#include <mutex>

#include "core/conversion/conversion.h"
#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

namespace {

constexpr std::size_t kMostConversions = 100;

// Also of a port of another application, to which nothing here is connected yet.
Result<DistantType> SourceType(const PathSearch& paths, Runtime& runtime, const std::string& path) {
  const auto from = paths.FindPort(path, PathKind::kOutput);
  if (from) return DistantType{&(*from)->type(), (*from)->unit()};
  const DistantPorts* const distant = DistantPorts::FindIn(runtime.root());
  if (!IsDistantPath(path) || distant == nullptr) return from.error();
  DistantType type = distant->TypeOf(path);
  return type.type != nullptr ? Result<DistantType>(std::move(type)) : from.error();
}

}  // namespace

std::string FindConversions(Inspection& inspection, const ViewerMessage& message) {
  Runtime& runtime = inspection.application().runtime;
  const std::lock_guard lock(runtime.structure_mutex());
  const PathSearch paths(runtime.root());
  const auto from = SourceType(paths, runtime, message.from);
  if (!from) return Refusal(message.request, {{from.error()}});
  const auto to = paths.FindPort(message.to, PathKind::kInput);
  if (!to) return Refusal(message.request, {{to.error()}});
  const auto candidates =
      ConversionCandidates({*from->type, (*to)->type(), {}, {}, from->unit, (*to)->unit()}, kMostConversions);
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "reply").AddOrNull("request", message.request).Add("ok", true);
    AppendList(candidates, json.Key("conversions"), [](const ConversionCandidate& each, std::string& text) {
      JsonObject(text).Add("part", each.part).Add("convert", each.name);
    });
  });
}

}  // namespace runnel::internal
