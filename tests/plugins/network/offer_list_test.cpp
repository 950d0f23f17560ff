#include "plugins/network/offer_list.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kRobot = "robot";
const std::string kScan = "/app/laser/output/scan";

TEST(OfferListTest, APortComesAndGoes) {
  OfferList list{kRobot, {}};
  ASSERT_TRUE(list.Add(kScan, {.topic = "/scan", .rate = 5}));
  EXPECT_EQ(list.offers.at(0).port, kScan);
  ASSERT_TRUE(list.Add(kScan, {}));  // by its own name, too
  const auto again = list.Add(kScan, {.topic = "/robot/laser/scan"});
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("is offered as /robot/laser/scan already"));
  ASSERT_TRUE(list.Remove(kScan, "/scan"));
  EXPECT_EQ(list.offers.size(), 1u);
  EXPECT_FALSE(list.Remove(kScan, "/scan"));
  ASSERT_TRUE(list.Remove(kScan, ""));
  EXPECT_THAT(list.offers, IsEmpty());
  EXPECT_THAT(list.Remove(kScan, "").error().message, HasSubstr("is not offered"));
}

TEST(OfferListTest, PatternsLeaveOutWhatIsOfferedNoMore) {
  OfferList list{kRobot, {{.patterns = {"laser/*", "localisation/pose"}}}};
  ASSERT_TRUE(list.Remove(kScan, ""));
  EXPECT_THAT(list.offers.at(0).patterns, ElementsAre("laser/*", "localisation/pose", "!/laser/scan"));
  ASSERT_TRUE(list.Add(kScan, {}));
  EXPECT_THAT(list.offers.at(0).patterns, ElementsAre("laser/*", "localisation/pose"));
  ASSERT_TRUE(list.Remove("/app/localisation/output/pose", ""));
  EXPECT_THAT(list.offers.at(0).patterns, ElementsAre("laser/*"));
  // In another way than the pattern says.
  ASSERT_TRUE(list.Remove(kScan, ""));
  ASSERT_TRUE(list.Add(kScan, {.quality = ValueQuality::kLatched}));
  EXPECT_EQ(list.offers.size(), 2u);
}

TEST(OfferListTest, PortsGoWithTheirModules) {
  OfferList list{kRobot, {{.port = kScan}, {.port = "/app/laser2/output/scan"}}};
  list.Rename("/app/laser", "/app/eyes");
  EXPECT_EQ(list.offers[0].port, "/app/eyes/output/scan");
  EXPECT_EQ(list.offers[1].port, "/app/laser2/output/scan");
}

// Of a module that has gone the offer stays, as it may come back; meanwhile another one may have got its name.
TEST(OfferListTest, OfTwoOffersOfOnePortAndTopicTheFirstIsSaved) {
  OfferList list{kRobot,
                 {{.port = "/app/eyes/output/scan", .rate = 5},
                  {.patterns = {"**"}},
                  {.patterns = {"**"}},
                  {.port = kScan},
                  {.port = kScan, .topic = "/scan"}}};
  list.Rename("/app/laser", "/app/eyes");
  list.DropSecond();
  ASSERT_EQ(list.offers.size(), 4u);
  EXPECT_EQ(list.offers[0].rate, 5);
  EXPECT_EQ(list.offers[3].topic, "/scan");
}

// What has been withdrawn stays so under another name.
TEST(OfferListTest, PatternsFromTheRootGoWithWhatTheyName) {
  OfferList list{kRobot,
                 {{.patterns = {"*/scan", "/laser/*", "/app/laser", "/laser2/scan", "laser/scan", "!/sonar/*"}}}};
  ASSERT_TRUE(list.Remove(kScan, ""));
  list.Rename("/app/laser", "/app/eyes");
  EXPECT_THAT(list.offers.at(0).patterns,
              ElementsAre("*/scan", "/eyes/*", "/app/eyes", "/laser2/scan", "!/sonar/*", "!/eyes/scan"));
  list.Rename("/app/eyes", "/app/laser");
  EXPECT_THAT(list.offers.at(0).patterns,
              ElementsAre("*/scan", "/laser/*", "/app/laser", "/laser2/scan", "!/sonar/*", "!/laser/scan"));
}

}  // namespace
}  // namespace runnel::test
