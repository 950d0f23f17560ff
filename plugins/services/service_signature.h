#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/port/output.h"
#include "plugins/services/call_record.h"
#include "plugins/services/client_form.h"

namespace runnel {

/// Publishes what has come of the calls of one service.
class CallRecorder {
 public:
  virtual ~CallRecorder() = default;
  /// Nothing, if nobody looks.
  virtual void Record(const CallBase& call, CallStatus status) = 0;
};

/// One signature of services, Reply(Arguments…), for those who offer or use such a service without having been compiled
/// with it.
///
/// Threads: any; what it makes, as there.
class ServiceSignature {
 public:
  /// `names`: of all arguments, or none.
  [[nodiscard]] virtual std::shared_ptr<const CallForm> MakeForm(const std::vector<std::string>& names) const = 0;
  [[nodiscard]] virtual std::unique_ptr<CallSlots> MakeSlots(std::size_t count) const = 0;
  /// With an output SERVICE_calls. nullptr: there are no records of this signature.
  [[nodiscard]] virtual std::unique_ptr<CallRecorder> MakeRecorder(FrameworkElement& group, const std::string& service) const = 0;
  /// `record` is one of this signature.
  virtual void TakeArguments(const CallRecordBase& record, CallBase& call) const = 0;

 protected:
  ~ServiceSignature() = default;
};

namespace internal {

// `has_records`: in place of one that has none.
void AddServiceSignature(const TypeInfo& link, const ServiceSignature& signature, bool has_records);

template <typename Signature>
class CallRecorderOf final : public CallRecorder {
 public:
  CallRecorderOf(FrameworkElement& group, const std::string& service)
      : records_(group, service + "_calls", {.description = "what has come of each call of " + service, .pool = {}}) {}
  void Record(const CallBase& call, CallStatus status) override {
    if (!records_.is_watched()) return;
    auto loan = records_.Loan();
    if (!loan) return;
    FillRecord(*loan, static_cast<const Call<Signature>&>(call), status);
    records_.Publish(std::move(loan), call.called_at);
  }

 private:
  Output<CallRecord<Signature>> records_;
};

template <typename Signature, bool has_records>
class ServiceSignatureOf final : public ServiceSignature {
 public:
  [[nodiscard]] std::shared_ptr<const CallForm> MakeForm(const std::vector<std::string>& names) const override {
    return std::make_shared<CallFormOf<Signature>>(names);
  }
  [[nodiscard]] std::unique_ptr<CallSlots> MakeSlots(std::size_t count) const override {
    return std::make_unique<CallSlotsOf<Signature>>(count);
  }
  [[nodiscard]] std::unique_ptr<CallRecorder> MakeRecorder([[maybe_unused]] FrameworkElement& group,
                                                           [[maybe_unused]] const std::string& service) const override {
    if constexpr (has_records) {
      return std::make_unique<CallRecorderOf<Signature>>(group, service);
    } else {
      return nullptr;
    }
  }
  void TakeArguments(const CallRecordBase& record, CallBase& call) const override {
    static_cast<Call<Signature>&>(call).arguments = static_cast<const CallRecord<Signature>&>(record).arguments;
  }
};

/// Called when a service or a client is made. Clients spare themselves the code of records.
template <typename Signature, bool has_records>
[[gnu::noinline]] void MakeServiceSignatureKnown() {
  static const ServiceSignatureOf<Signature, has_records> signature;
  static const bool is_known = (AddServiceSignature(TypeOf<ServiceLink<Signature>>(), signature, has_records), true);
  (void)is_known;
}

}  // namespace internal

}  // namespace runnel
