// Descriptions with mistakes put in at random neither crash nor hang what reads them; meant to be run with the
// sanitizers, too.

#include "tests/plugins/genom_description/mutation.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "plugins/genom_description/description.h"
#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

// How many: RUNNEL_MUTATIONS in the environment says another number, for long runs with the sanitizers.
int Count() {
  const char* const said = std::getenv("RUNNEL_MUTATIONS");
  return said != nullptr ? std::atoi(said) : 400;
}

TEST(GenomMutationTest, WhateverIsReadEnds) {
  const std::vector<std::string> seeds = {
      FileText("courier.gen"),
      "#define A(x) x ## 1\n#if defined(A) && 2 > 1\ntypedef long A(b);\n#else\n#endif\nstruct s; typedef sequence<s> "
      "t;\n"
      "struct s { t under; };\nunion u switch(long) { case 1: case 2: s a; default: double b; };\n"};
  const int count = Count();
  std::mt19937 random(20);
  int right = 0;
  for (int i = 0; i < count; ++i) {
    Diagnostics diagnostics;
    const auto description = genom::ReadDescriptionText(Mutated(seeds, random), "nowhere/test.gen", {}, diagnostics);
    if (!diagnostics.ok()) continue;
    ++right;
    EXPECT_FALSE(genom::DescriptionJson(*description).empty());
  }
  EXPECT_GT(right, 0);
  EXPECT_LT(right, count);
}

}  // namespace
}  // namespace runnel::test
