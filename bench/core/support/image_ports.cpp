// The image transport by Runnel's modules: a camera in a periodic thread, consumers in threads that
// run when data comes.

#include <string>
#include <thread>
#include <utility>

#include "bench/core/support/image_stage.h"
#include "bench/core/support/images.h"
#include "bench/core/support/star.h"
#include "core/module/module.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::bench {

namespace {

class Camera final : public Module {
 public:
  using Module::Module;
  Output<Image> out{this, "out", {.pool = {.buffers = kImageBuffers}}};

 private:
  Result<void> Prepare() override {
    PrepareImages(out);
    return {};
  }
  void Update() override {
    auto loan = out.Loan();
    FillImage(*loan, ++number_);
    out.Publish(std::move(loan));
  }

  std::uint64_t number_ = 0;
};

class Consumer final : public Module {
 public:
  Consumer(const Placement& placement, Audience& audience) : Module(placement), audience_(audience) {}
  Input<Image> in{this, "in", {.trigger = true}};

 private:
  void Update() override {
    if (const auto image = in.Read(); image.is_new()) audience_.LookAt(*image);
  }

  Audience& audience_;
};

}  // namespace

ImageCost MeasureImagePorts(double seconds, int readers) {
  Audience audience;
  Runtime runtime;
  Scheduler scheduler(runtime);
  auto& camera = runtime.Create<Camera>(runtime.root(), "camera");
  AssignThread(camera, CreateThread(runtime, "camera", {.period = kImagePeriod}));
  for (int i = 0; i < readers; ++i) {
    const std::string name = "consumer" + std::to_string(i);
    auto& consumer = runtime.Create<Consumer>(runtime.root(), name, audience);
    MustSucceed(Port::Connect(camera.out, consumer.in));
    AssignThread(consumer, CreateThread(runtime, name, {.activation = ThreadOptions::Activation::kTrigger}));
  }
  MustSucceed(runtime.MakeReady(runtime.root()));
  MustSucceed(scheduler.Start());
  const ImageCost cost =
      CostOf(seconds, readers, audience, [&] { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); });
  scheduler.Stop();
  return cost;
}

}  // namespace runnel::bench
