#include "plugins/finroc_files/finroc_names.h"

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(FinrocNames, BecomeSnakeCase) {
  EXPECT_EQ(SnakeCase("AddNoise Front"), "add_noise_front");
  EXPECT_EQ(SnakeCase("Ir Distance Front"), "ir_distance_front");
  EXPECT_EQ(SnakeCase("CrashCourse"), "crash_course");
  EXPECT_EQ(SnakeCase("PTUControl2D"), "ptu_control2_d");
  EXPECT_EQ(SnakeCase("XML file"), "xml_file");
  EXPECT_EQ(SnakeCase("String[2], x"), "string_2_x");
  EXPECT_EQ(SnakeCase("already_so"), "already_so");
  EXPECT_EQ(SnakeCase(""), "_");
  EXPECT_EQ(SnakeCase("[]"), "_");
}

TEST(FinrocNames, OfPathsAreDecoded) {
  EXPECT_EQ(SnakeCasePath("Group 1/Output/Array%3Cuint8, 8%3E"), "group_1/output/array_uint8_8");
  EXPECT_EQ(SnakeCasePath("/Control//Sensor%20Input/Pose/"), "control/sensor_input/pose");
  EXPECT_EQ(SnakeCasePath("100%"), "100");
  EXPECT_EQ(SnakeCasePath(""), "");
}

TEST(FinrocNames, OfLibrariesLoseWhatAllHave) {
  EXPECT_EQ(LibraryName("finroc_projects_crash_course"), "crash_course");
  EXPECT_EQ(LibraryName("finroc_plugins_structure"), "structure");
  EXPECT_EQ(LibraryName("rrlib_math"), "math");
  EXPECT_EQ(LibraryName("mine"), "mine");
}

}  // namespace
}  // namespace runnel
