#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

#include <runnel/application.h>
#include <runnel/types.h>

using namespace runnel;

/// Lets the robot of an application file drive, gives it another planner on its way, and says where it is.
int main(int count, char** words) {
  ApplicationOptions options;
  for (int i = 2; i < count; ++i) options.settings.emplace_back(words[i]);
  const auto application = Application::Load(count > 1 ? words[1] : "", options);
  if (!application) {
    std::cerr << application.diagnostics().ToString();
    return 2;
  }
  if (const auto started = application->Start(); !started) return 1;
  const auto pose = [&] { return application->Read<Pose2>("/world/pose").value().value_or(Pose2{}); };
  const auto drive = [&](double metres) {
    const Pose2 from = pose();
    while (std::hypot(pose().x - from.x, pose().y - from.y) < metres) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  };
  drive(0.5);
  const ChangeOutcome swapped = application->Swap("/robot/planner", "planning/tangent_bug");
  std::cerr << swapped.diagnostics.ToString();
  if (!swapped) return 1;
  std::cout << "swapped at " << pose().x << ", " << pose().y << std::endl;
  drive(0.5);
  application->Stop();
  std::cout << "the robot is at " << pose().x << ", " << pose().y << std::endl;
}
