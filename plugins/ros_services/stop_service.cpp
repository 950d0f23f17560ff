#include "plugins/ros_services/stop_service.h"

#include <new>
#include <utility>

#include "plugins/cdr_values/cdr_stream.h"

namespace runnel {

namespace {
constexpr std::uint32_t kStopIdentity = 0x80000100u;  // beyond those of parameters

// Without memory for a name the STOP is pressed all the same.
std::string Presser(const std::string& service) noexcept {
  try {
    return "the service " + service;
  } catch (const std::bad_alloc&) {
    return {};
  }
}
}  // namespace

Result<std::unique_ptr<StopService>> StopService::Start(Runtime& runtime, bool may_release, const std::string& node,
                                                        WireParticipant& participant, ServiceDialect dialect,
                                                        std::function<bool()> is_kept,
                                                        std::function<Result<void>()> check,
                                                        const DiscoveryTable* table) {
  const std::string name = (node == "/" ? "" : node) + "/stop";
  std::unique_ptr<StopService> made(new StopService(runtime, may_release, name, std::move(is_kept), std::move(check)));
  auto endpoints = ServiceEndpoints::Start(ServiceEndpoints::Side::kServer,
                                           {.service = made->name_,
                                            .request = ServiceType::OfRos("std_srvs/srv/SetBool_Request"),
                                            .response = ServiceType::OfRos("std_srvs/srv/SetBool_Response"),
                                            .dialect = dialect,
                                            .table = table},
                                           participant, kStopIdentity, [self = made.get()] { self->Serve(); });
  if (!endpoints) return endpoints.error();
  made->endpoints_ = std::move(*endpoints);
  made->known_ = made->endpoints_.get();
  made->Serve();  // what has come meanwhile
  return made;
}

void StopService::Serve() noexcept {
  ServiceEndpoints* const endpoints = known_;
  if (endpoints == nullptr) return;
  try {
    const std::lock_guard lock(serving_);
    endpoints->TakeWaiting([&](const ServiceMessage& request) { Serve(request); });
  } catch (...) {
    is_left_.store(true, std::memory_order_relaxed);
  }
}

void StopService::Serve(const ServiceMessage& request) noexcept {
  try {
    Answer answer = Do(request);
    if (answer.success && is_kept_ && !is_kept_()) answer.message += "; the next process would not know of it yet";
    Octets octets;
    CdrWriter to(octets);
    to.Put(answer.success);
    to.PutText(answer.message);
    (void)known_.load()->Reply(request.id, octets);  // who does not hear it asks again
  } catch (...) {
    // For lack of memory: there is no answer, which whoever waits for one takes for what it is.
  }
}

StopService::Answer StopService::Do(const ServiceMessage& request) {
  auto from = CdrReader::Begin(request.message);
  bool is_press = false;
  if (!from || !from->Get(is_press)) return {false, "the request is no std_srvs/srv/SetBool"};
  std::string by = Presser(name_);
  RobotStop& stop = runtime_.robot_stop();
  if (is_press) {
    std::string done = stop.Press(std::move(by)) ? "the robot is stopped" : "the robot was stopped already";
    const auto all = check_ ? check_() : Result<void>();
    return {all.has_value(), all ? std::move(done) : all.error().message};
  }
  if (!may_release_)
    return {false, "the STOP is not released by this service: its file does not say <ros stop_releases=\"true\">"};
  const auto released = stop.Release(std::move(by), {.asked = request.sent, .requests = {}});
  if (released) return {true, "the STOP is released"};
  return {false, released.error().ToString()};
}

}  // namespace runnel
