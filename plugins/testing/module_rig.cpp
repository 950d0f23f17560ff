#include "plugins/testing/module_rig.h"

#include "core/base/error.h"
#include "core/log/logger.h"
#include "core/module/executable.h"
#include "core/paths/path_search.h"
#include "core/types/type_info.h"

namespace runnel::test {

namespace {

// Errors of a test are the test's: they end it.
template <typename T>
T Need(Result<T> result) {
  if (!result) throw ElementError(result.error());
  return *std::move(result);
}
void Need(const Result<void>& result) {
  if (!result) throw ElementError(result.error());
}

}  // namespace

ModuleRigBase::ModuleRigBase(Duration period)
    : surroundings_(runtime.Create<Group>(runtime.root(), "surroundings")), period_(period) {
  runtime.set_clock(clock_);
}

ModuleRigBase::~ModuleRigBase() = default;

FrameworkElement& ModuleRigBase::Make(std::string_view type, const std::filesystem::path& plugin_folder) {
  if (!plugin_folder.empty()) plugins_.AddSearchFolder(plugin_folder);
  Need(plugins_.Load(type.substr(0, type.find('/'))));
  return *Need(plugins_.modules().Create(type, runtime.root(), "module"));
}

void ModuleRigBase::Set(std::string_view parameter, std::string_view text) {
  const std::lock_guard lock(runtime.structure_mutex());
  FrameworkElement* const found = Need(PathSearch(*module_).Find(parameter, PathKind::kParameter));
  auto* const configurable = dynamic_cast<Configurable*>(found);
  if (configurable == nullptr) {
    throw ElementError({.message = "this is no parameter", .path = found->path()});
  }
  Need(configurable->SetFromText(text));
}

Result<void> ModuleRigBase::Prepare() { return runtime.MakeReady(*module_); }

Port& ModuleRigBase::FindPort(std::string_view name, Port::Direction direction) {
  const std::lock_guard lock(runtime.structure_mutex());
  Need(Runtime::Construct(*module_));
  const bool is_input = direction == Port::Direction::kInput;
  return *Need(PathSearch(*module_).FindPort(name, is_input ? PathKind::kInput : PathKind::kOutput));
}

std::string ModuleRigBase::FreeNameFor(const Port& port) const { return FreeName(surroundings_, port.name()); }

void ModuleRigBase::RefuseType(const Port& port, const TypeInfo& wanted) {
  const std::string kind = port.direction() == Port::Direction::kInput ? "input" : "output";
  throw ElementError({.message = "this is an " + kind + " of type " + port.type().name() +
                                 ", not what was asked for with type " + wanted.name(),
                      .path = port.path()});
}

void ModuleRigBase::UseQueue(Port& input, std::size_t capacity, OnFull on_full) {
  RUNNEL_CHECK(!feeders_.contains(&input), "values have been fed without a queue already");
  queues_[&input] = {.queue = capacity, .on_full = on_full};
}

void ModuleRigBase::Connect(Port& from, Port& to, const ConnectOptions& options) {
  Need(Port::Connect(from, to, options));
}

void ModuleRigBase::SetWatch(TaskWatch* watch) {
  watch_ = watch;
  watched_.clear();
}

void ModuleRigBase::RunCycle() {
  if (module_->life_cycle() == LifeCycle::kConstructed) Need(Prepare());
  const std::vector<Task> tasks = module_->FindAnnotation<Executable>()->tasks();
  if (watch_ != nullptr && watched_.empty()) {
    for (const Task& task : tasks) watched_.push_back(watch_->Watch(task));
  }
  PrepareLogging();  // as threads do that run cycles
  ++cycles_;
  {
    const CycleScope cycle({now(), period_});
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      watched_.empty() ? tasks[i].run() : watched_[i]->Run();
    }
  }
  clock_.Advance(period_);
}

std::optional<Fault> ModuleRigBase::RunUntilFault(std::uint64_t most_cycles) {
  for (; most_cycles > 0; --most_cycles) {
    const Time began = now();
    try {
      RunCycle();
    } catch (...) {
      clock_.Advance(period_);
      return Fault{module_->path(), DescribeException().substr(0, kLongestFaultMessage), began, cycles_};
    }
  }
  return std::nullopt;
}

}  // namespace runnel::test
