#include <algorithm>
#include <memory>

#include "core/types/type_of.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/application_tags/tag_list.h"

namespace runnel {

namespace {

struct ClockChoice final : Annotation {
  SchedulerOptions options;
  int line = 0;
};

void RefuseInRealTime(const XmlAttribute& attribute, std::string message, const TagUse& use,
                      const ClockChoice& choice) {
  if (choice.options.clock != SchedulerOptions::ClockKind::kReal) return;
  use.Report({.message = std::move(message), .hint = "leave out " + attribute.name + ", or write type=\"simulated\""},
             attribute.position);
}

void ReadSpeed(const TagUse& use, ClockChoice& choice) {
  const XmlAttribute* const speed = use.Find("speed");
  if (speed == nullptr) return;
  choice.options.speed = ParseNumber(speed->value).value();
  if (choice.options.speed < 0) {
    use.Report({.message = "time cannot run backwards", .hint = "1 is real time, 0 as fast as it can"},
               speed->value_position);
  } else if (!Pacing::Takes(choice.options.speed)) {
    use.Report({.message = "speed " + speed->value + " is out of bounds",
                .hint = "allowed is 0 (as fast as it can), or 1e-6 .. 1e6"},
               speed->value_position);
  }
  RefuseInRealTime(*speed, "the speed of real time cannot be chosen", use, choice);
}

void CheckPort(const TagUse& use, ClockChoice& choice) {
  const XmlAttribute& named = use.Get("port");
  const Port* const port = SearchPort(PathIn(named, use.parent), PathKind::kOutput, use.context);
  if (port == nullptr) return;
  if (&port->type() == &TypeOf<double>() || &port->type() == &TypeOf<std::int64_t>()) {
    choice.options.clock_port = port->path();
    return;
  }
  use.context.Report({.message = "carries " + port->type().name() + ", which is no time",
                      .path = port->path(),
                      .hint = "a time is a double in seconds, or an int64 in nanoseconds"},
                     named.value_position, use.parent);
}

void ReadPort(const TagUse& use, ClockChoice& choice) {
  const XmlAttribute* const port = use.Find("port");
  if (choice.options.follows_outside_clock) {
    if (port == nullptr) return;
    use.context.Defer(BuildStage::kChecks, [use, &choice] { CheckPort(use, choice); });
  } else if (port != nullptr) {
    use.Report(
        {.message = "only a clock from outside is said by a port", .hint = "leave out port, or write type=\"outside\""},
        port->position);
  }
}

void ReadPaused(const TagUse& use, ClockChoice& choice) {
  const XmlAttribute* const paused = use.Find("paused");
  if (paused == nullptr) return;
  choice.options.is_paused = paused->value == "true";
  RefuseInRealTime(*paused, "real time cannot be paused", use, choice);
}

FrameworkElement* ChooseClock(const TagUse& use) {
  if (const auto* first = use.parent.FindAnnotation<ClockChoice>()) {
    use.Report({.message = "the clock is chosen twice", .hint = "the first is in line " + std::to_string(first->line)},
               use.xml.position());
    return &use.parent;
  }
  auto& choice = use.parent.Annotate(std::make_unique<ClockChoice>());
  choice.line = use.xml.position().line;
  const bool is_outside = use.Get("type").value == "outside";
  const bool is_simulated = is_outside || use.Get("type").value == "simulated";
  choice.options.clock = is_simulated ? SchedulerOptions::ClockKind::kSimulated : SchedulerOptions::ClockKind::kReal;
  choice.options.follows_outside_clock = is_outside;
  if (is_simulated && !is_outside) choice.options.speed = 1;
  ReadSpeed(use, choice);
  ReadPort(use, choice);
  ReadPaused(use, choice);
  return &use.parent;
}

std::vector<SavedTag> SavedClock(const FrameworkElement& application) {
  const auto* const choice = application.FindAnnotation<ClockChoice>();
  if (choice == nullptr) return {};
  const bool is_simulated = choice->options.clock == SchedulerOptions::ClockKind::kSimulated;
  const bool is_outside = choice->options.follows_outside_clock;
  std::vector<SavedAttribute> tag{{"type", is_outside ? "outside" : (is_simulated ? "simulated" : "real")}};
  if (is_outside) tag.push_back({.name = "port", .value = "", .is_default = true, .is_kept = true});
  if (is_simulated && !is_outside) {
    tag.push_back({"speed", TextOf(choice->options.speed), choice->options.speed == 1});
  }
  if (is_simulated) {
    tag.push_back({"paused", choice->options.is_paused ? "true" : "false", !choice->options.is_paused});
  }
  return {SavedTag{std::move(tag)}};
}

}  // namespace

SchedulerOptions SchedulerOptionsOf(const FrameworkElement& application) {
  const auto* const choice = application.FindAnnotation<ClockChoice>();
  return choice != nullptr ? choice->options : SchedulerOptions{};
}

bool LivesInSimulatedTime(XmlElement application) {
  return std::ranges::any_of(application.children(), [](const XmlElement& each) {
    const XmlAttribute* const type = each.name() == "clock" ? each.Attribute("type") : nullptr;
    return type != nullptr && type->value != "real";
  });
}

XmlTag ClockTag() {
  return {
      .name = "clock",
      .summary = "which time the application lives in; without it, real time",
      .parents = {"application"},
      .attributes = {WordRule("type", {"real", "simulated", "outside"},
                              "outside: simulated time that another simulator's or ROS's clock says", true),
                     PathRule("port", false,
                              "of a clock from outside: the output that says it, in seconds "
                              "(double) or nanoseconds (int64); without, the program does"),
                     KindRule(
                         "speed", AttributeKind::kNumber,
                         "of simulated time, at most; 1 (which it is by default) is real time, 0 as fast as it can"),
                     YesNoRule("paused",
                               "whether simulated time stands still until somebody lets it go on; false by default")},
      .handle = ChooseClock,
      .saved = SavedClock};
}

}  // namespace runnel
