#include "core/plugin/abi_difference.h"

#include <gmock/gmock.h>

namespace runnel {
namespace {

constexpr const char* kPlain = "runnel-abi-1 gxx1017 libstdcxx12 cxx11abi1 pointer8";

std::string With(const std::string& flag) { return kPlain + (" " + flag); }

TEST(AbiDifferenceTest, NamesTheFlagThatOnlyThePluginHas) {
  const AbiDifference difference = FindAbiDifference(With("avx512"), kPlain);
  EXPECT_EQ(difference.why, "it is built for AVX-512, this core is not");
  EXPECT_EQ(difference.cure,
            "build the plugin without -march=native, -mavx512f and the like, or Runnel with the same flags");
}

TEST(AbiDifferenceTest, NamesTheFlagThatOnlyTheCoreHas) {
  const AbiDifference difference = FindAbiDifference(kPlain, With("address-sanitizer"));
  EXPECT_EQ(difference.why, "this core is built with AddressSanitizer, the plugin is not");
  EXPECT_EQ(difference.cure, "build the plugin with -fsanitize=address, as this core is");
}

TEST(AbiDifferenceTest, NamesAllFlagsThatDiffer) {
  const AbiDifference difference = FindAbiDifference(With("debug avx"), With("avx512"));
  EXPECT_EQ(difference.why,
            "it is built for AVX, this core for AVX-512; it is built with the debug mode of the standard library, "
            "this core is not");
  EXPECT_THAT(difference.cure, testing::HasSubstr("-mavx512f"));
  EXPECT_THAT(difference.cure, testing::HasSubstr("-D_GLIBCXX_DEBUG"));
}

TEST(AbiDifferenceTest, AnotherCompilerIsToldWithBothFingerprints) {
  const AbiDifference difference = FindAbiDifference("runnel-abi-1 gxx1018 libstdcxx13 cxx11abi1 pointer8 avx", kPlain);
  EXPECT_THAT(difference.why, testing::HasSubstr("libstdcxx13 cxx11abi1 pointer8 avx', this core with '"));
  EXPECT_EQ(difference.cure, "rebuild the plugin with the compiler of the core");
  EXPECT_THAT(FindAbiDifference("", kPlain).cure, testing::HasSubstr("the compiler"));
}

}  // namespace
}  // namespace runnel
