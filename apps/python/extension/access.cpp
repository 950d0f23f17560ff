// Values, services, logs: what is looked at in an application, and said to it.

#include "apps/python/extension/access.h"

#include <array>
#include <chrono>
#include <mutex>
#include <thread>

#include "apps/python/extension/errors.h"
#include "apps/python/extension/value.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/command_service/application_log.h"
#include "plugins/services/callable.h"

namespace py = pybind11;

namespace runnel::python {

py::object Get(const Open& open, const std::string& path) {
  std::shared_ptr<void> value;
  const TypeInfo* type = nullptr;
  const auto get = [&](Application& application) -> Result<void> {
    const std::lock_guard lock(application.runtime().structure_mutex());
    const auto found = PathSearch(application.runtime()).Find(path, PathKind::kParameter);
    if (!found) return found.error();
    const auto* const parameter = dynamic_cast<const Configurable*>(*found);
    if (parameter == nullptr) return Error{.message = "is no parameter", .path = (*found)->path()};
    value = parameter->Value();
    type = &parameter->type();
    return {};
  };
  Checked(WithoutGil(open, get));
  return ToPython(*type, value.get(), std::make_shared<Memory>(Memory{.kept = value}));
}

py::object ReadInput(const Open& open, const std::string& path) {
  std::shared_ptr<void> value;
  const TypeInfo* type = nullptr;
  const auto look = [&](Application& application) -> Result<bool> {
    const std::lock_guard lock(application.runtime().structure_mutex());
    const auto found = PathSearch(application.runtime()).FindPort(path, PathKind::kOutput);
    if (!found) return found.error();
    if ((*found)->direction() == Port::Direction::kOutput || (*found)->is_proxy()) return false;
    type = &(*found)->type();
    (void)(*found)->VisitLatest([&](const void* newest, ValueTimes) {
      value = type->Make();
      if (value && !CopyValue(*type, newest, value.get())) value.reset();
    });
    return true;
  };
  if (!Checked(WithoutGil(open, look))) return py::cast(std::make_shared<Reader>(open, path, 0));
  if (!value) return py::none();
  return ToPython(*type, value.get(), std::make_shared<Memory>(Memory{.kept = value}));
}

void PublishByHand(const Open& open, const std::string& path, const py::object& value) {
  const Use use(*open);
  Runtime& runtime = use->runtime();
  const RobotStop::AsOf as_of = runtime.robot_stop().AsOfNow();
  Port* port = nullptr;
  const auto find = [&](Application&) -> Result<const TypeInfo*> {
    const std::lock_guard lock(runtime.structure_mutex());
    const auto found = PathSearch(runtime).FindPort(path, PathKind::kInput);
    if (!found) return found.error();
    port = *found;
    return &port->type();
  };
  const TypeInfo& type = *Checked(WithoutGil(open, find));
  const Value made = NewValue(type);
  FromPython(type, value, made.at);
  const auto publish = [&](Application& application) -> Result<void> {
    const std::lock_guard lock(runtime.structure_mutex());
    if (auto again = find(application); !again || *again != &type)
      return Error{.message = "has gone meanwhile", .path = path};
    return port->PublishByHand([&](void* at) -> Result<void> {
      if (auto known = runtime.robot_stop().CheckIsKnown(as_of); !known) return known;
      if (CopyValue(type, made.at, at)) return {};
      return Error{.message = "cannot have such a value"};
    });
  };
  Checked(WithoutGil(open, publish));
}

py::object Call(const Open& open, const std::string& path, double timeout, const py::args& positional,
                const py::kwargs& named) {
  if (!positional.empty() && !named.empty())
    throw py::type_error("a call has one argument, or arguments by their names");
  const Use use(*open);
  std::shared_ptr<AnyCall> call;
  const TypeInfo* reply = nullptr;
  std::exception_ptr thrown;
  const RobotStop::AsOf as_of = use->runtime().robot_stop().AsOfNow();
  const auto begin = [&](Application& application) -> Result<void> {
    const std::lock_guard lock(application.runtime().structure_mutex());
    const auto found = FindCallable(application.runtime(), path);
    if (!found) return found.error();
    Callable* const callable = *found;
    call = callable->NewCall();
    reply = callable->reply();
    {
      const GilInCycle gil;  // after the structure lock, never before it
      try {
        const bool has_some = !positional.empty() || !named.empty();
        if (callable->arguments() == nullptr) {
          if (has_some) throw py::type_error("the service takes no arguments");
        } else {
          const bool is_enough = has_some || callable->are_arguments_optional();
          if (!is_enough || positional.size() > 1)
            throw py::type_error("the service wants " + ToText(*callable->arguments(), call->arguments()));
          const py::object said = positional.empty() ? py::object(named) : py::object(positional[0]);
          if (has_some) FromPython(*callable->arguments(), said, call->arguments(), false);
          for (const std::string& each : callable->required()) {
            if (py::isinstance<py::dict>(said) && !said.contains(each))
              throw py::type_error("the service wants '" + each + "', too");
          }
        }
      } catch (...) {
        thrown = std::current_exception();
        return {};
      }
    }
    (void)call->Begin(application.runtime().clock().Now(), FromSeconds(timeout), as_of);
    return {};
  };
  const auto begun = WithoutGil(open, begin);
  if (thrown) std::rethrow_exception(thrown);
  Checked(begun);
  CallStatus status = CallStatus::kPending;
  while ((status = call->Poll(use->runtime().clock().Now())) == CallStatus::kPending) {
    const bool nobody_runs = !use->is_running() && open->runs_in == std::thread::id();
    if (nobody_runs && use->scheduler().pace().is_simulated()) {
      Step(open, 1);
    } else {
      WithoutGil([] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); });
    }
    LookAround(*open);
  }
  if (status != CallStatus::kAnswered) {
    const std::string why = call->error();
    Throw({.message = std::string("the call has ended: ") + CallStatusName(status) + (why.empty() ? "" : ": " + why),
           .path = path});
  }
  if (reply == nullptr) return py::none();
  return ToPython(*reply, ForLooking(call->reply()), std::make_shared<Memory>(Memory{.kept = call}));
}

py::list Paths(const Open& open) {
  std::vector<std::array<std::string, 3>> rows;
  WithoutGil(open, [&](Application& application) {
    const std::lock_guard lock(application.runtime().structure_mutex());
    application.element().Visit([&](FrameworkElement& each) {
      if (const auto* const port = dynamic_cast<const Port*>(&each)) {
        const bool is_input = port->direction() == Port::Direction::kInput;
        rows.push_back({each.path(),
                        each.FindAnnotation<Callable>() != nullptr ? "service"
                        : is_input                                 ? "input"
                                                                   : "output",
                        port->type().name()});
      } else if (const auto* const parameter = dynamic_cast<const Configurable*>(&each)) {
        rows.push_back({each.path(), "parameter", parameter->type().name()});
      } else if (each.kind() == ElementKind::kModule) {
        rows.push_back({each.path(), "module", FindModuleType(each)});
      } else if (each.kind() == ElementKind::kGroup) {
        rows.push_back({each.path(), "group", ""});
      }
    });
  });
  py::list all;
  for (const auto& [path, kind, type] : rows) all.append(py::make_tuple(path, kind, type));
  return all;
}

py::list Log(const Open& open, std::uint64_t from) {
  const Use use(*open);
  const auto found = WithoutGil([&] { return use->log().ReadEntries(from, ApplicationLog::kMostEntries); });
  py::list all;
  for (const auto& each : found.entries) {
    all.append(py::make_tuple(ToSeconds(each.time), ApplicationLog::KindName(each.kind), each.module, each.text));
  }
  return all;
}

py::list Events(const Open& open) {
  constexpr const char* kKinds[] = {"warning", "fault", "notice", "failure", "message"};
  const Use use(*open);
  const auto events = WithoutGil([&] { return use->TakeEvents(); });
  py::list all;
  for (const ApplicationEvent& each : events) {
    all.append(py::make_tuple(kKinds[static_cast<std::size_t>(each.kind)], each.fault ? each.fault->path : "",
                              each.fault ? each.fault->message : "", each.text));
  }
  return all;
}

}  // namespace runnel::python
