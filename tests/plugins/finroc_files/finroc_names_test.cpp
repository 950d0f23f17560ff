#include "plugins/finroc_files/finroc_names.h"

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(FinrocNames, BecomeSnakeCase) {
  EXPECT_EQ(RunnelName("AddNoise Front"), "add_noise_front");
  EXPECT_EQ(RunnelName("Ir Distance Front"), "ir_distance_front");
  EXPECT_EQ(RunnelName("CrashCourse"), "crash_course");
  EXPECT_EQ(RunnelName("PTUControl2D"), "ptu_control2_d");
  EXPECT_EQ(RunnelName("XML file"), "xml_file");
  EXPECT_EQ(RunnelName("String[2], x"), "string_2_x");
  EXPECT_EQ(RunnelName("already_so"), "already_so");
  EXPECT_EQ(RunnelName(""), "_");
  EXPECT_EQ(RunnelName("[]"), "_");
}

TEST(FinrocNames, OfPathsAreDecoded) {
  EXPECT_EQ(RunnelPath("Group 1/Output/Array%3Cuint8, 8%3E"), "group_1/output/array_uint8_8");
  EXPECT_EQ(RunnelPath("/Control//Sensor%20Input/Pose/"), "control/sensor_input/pose");
  EXPECT_EQ(RunnelPath("100%"), "100");
  EXPECT_EQ(RunnelPath(""), "");
}

TEST(FinrocNames, OfLibrariesLoseWhatAllHave) {
  EXPECT_EQ(LibraryName("finroc_projects_crash_course"), "crash_course");
  EXPECT_EQ(LibraryName("finroc_plugins_structure"), "structure");
  EXPECT_EQ(LibraryName("rrlib_math"), "math");
  EXPECT_EQ(LibraryName("mine"), "mine");
}

}  // namespace
}  // namespace runnel
