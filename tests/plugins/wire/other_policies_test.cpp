// What others ask for besides, in words.
#include <gmock/gmock.h>

#include "plugins/wire/wire.h"

namespace runnel::test {
namespace {

TEST(OtherPoliciesTest, SayWhatIsNotMet) {
  EXPECT_EQ(OtherPolicies{}.Unmet(false), "");
  EXPECT_EQ((OtherPolicies{.partitions = {"b", "*"}, .representations = {2, 0}}.Unmet(false)), "");
  EXPECT_EQ((OtherPolicies{.durability = 2, .has_deadline = true}.Unmet(true)), "") << "is offered";
  EXPECT_EQ((OtherPolicies{.representations = {2, 0}}.Unmet(true)), "XCDR2") << "the first one is what it writes";
  EXPECT_EQ((OtherPolicies{.has_lease = true}.Unmet(false)), "a liveliness");
  EXPECT_EQ((OtherPolicies{
                .durability = 2, .liveliness = 1, .has_deadline = true, .partitions = {"b"}, .representations = {2}}
                 .Unmet(false)),
            "the partition 'b', XCDR2, a deadline, a liveliness, values that outlive their writer (durability)");
}

}  // namespace
}  // namespace runnel::test
