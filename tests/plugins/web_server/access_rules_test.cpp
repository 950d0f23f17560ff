#include "plugins/web_server/access_rules.h"

#include <gmock/gmock.h>

namespace runnel::test {

namespace {

using ::testing::HasSubstr;

constexpr std::string_view kHost = "127.0.0.1:8765";

AccessRules Rules(std::string token = {}, std::vector<std::string> origins = {}) {
  return AccessRules(std::move(token), {"Robot.Lan"}, std::move(origins), 8765);
}

TEST(AccessRules, LetsWhoCallsItByAddressOrNameIn) {
  const AccessRules rules = Rules();
  for (const char* host :
       {"127.0.0.1:8765", "127.0.0.1", "localhost:8765", "LOCALHOST", "[::1]:8765", "[::1]",
        "192.168.1.7:8765", "robot.lan:8765", "ROBOT.LAN"}) {
    EXPECT_FALSE(rules.Check({.target = "/", .host = host})) << host;
  }
}

TEST(AccessRules, RefusesNamesThatSomebodyElseLetsLeadHere) {
  const AccessRules rules = Rules();
  for (const char* host : {"evil.example:8765", "localhost.evil.example", "127.0.0.1.evil.example",
                           "127.0.0.1:8765.evil", "[::1", "[::1]evil", "", ":8765",
                           "localhost:", "localhost:123456", "127.0.0.1 "}) {
    EXPECT_TRUE(rules.Check({.target = "/", .host = host})) << host;
  }
}

TEST(AccessRules, TakesATokenFromAddressCookieOrAuthorization) {
  const AccessRules rules = Rules("open-sesame");
  EXPECT_EQ(rules.Check({.target = "/", .host = kHost})->status, 401U);
  EXPECT_FALSE(rules.Check({.target = "/?token=open-sesame", .host = kHost}));
  EXPECT_FALSE(rules.Check({.target = "/?a=b&token=open-sesame&c", .host = kHost}));
  EXPECT_FALSE(rules.Check({.target = "/", .host = kHost, .authorization = "bearer open-sesame"}));
  EXPECT_FALSE(rules.Check(
      {.target = "/", .host = kHost, .cookie = "a=b; runnel_token_8765=open-sesame; c=d"}));
}

TEST(AccessRules, RefusesWhatIsAlmostTheToken) {
  const AccessRules rules = Rules("open-sesame");
  for (const char* target :
       {"/?token=open-sesam", "/?token=open-sesame1", "/?token=", "/?token",
        "/?mytoken=open-sesame", "/?token=OPEN-SESAME", "/token=open-sesame"}) {
    EXPECT_TRUE(rules.Check({.target = target, .host = kHost})) << target;
  }
  EXPECT_TRUE(rules.Check({.target = "/", .host = kHost, .cookie = "runnel_token_1=open-sesame"}));
  EXPECT_TRUE(rules.Check({.target = "/", .host = kHost, .authorization = "Basic open-sesame"}));
  EXPECT_TRUE(rules.Check({.target = "/", .host = kHost, .authorization = "open-sesame"}));
}

TEST(AccessRules, SetsTheCookieOnceTheTokenWasInTheAddress) {
  const AccessRules rules = Rules("open-sesame");
  EXPECT_THAT(rules.CookieFor({.target = "/?token=open-sesame", .host = kHost}),
              HasSubstr("runnel_token_8765=open-sesame; Path=/; HttpOnly; SameSite=Strict"));
  EXPECT_EQ(rules.CookieFor({.target = "/?token=open", .host = kHost}), "");
  EXPECT_EQ(Rules().CookieFor({.target = "/?token=", .host = kHost}), "");
}

TEST(AccessRules, LetsPagesOfItsOwnAndListedOriginsTalk) {
  const AccessRules rules = Rules({}, {"https://app.example.org"});
  for (const char* origin : {"", "http://127.0.0.1:8765", "HTTP://127.0.0.1:8765",
                             "https://127.0.0.1:8765", "https://app.example.org"}) {
    EXPECT_FALSE(rules.CheckOrigin({.target = "/", .host = kHost, .origin = origin})) << origin;
  }
  for (const char* origin :
       {"null", "http://127.0.0.1", "http://127.0.0.1:8766", "http://localhost:8765", "file://",
        "http://127.0.0.1:8765.evil.example", "https://app.example.org.evil.example",
        "http://app.example.org"}) {
    EXPECT_EQ(rules.CheckOrigin({.target = "/", .host = kHost, .origin = origin})->status, 403U)
        << origin;
  }
}

TEST(AccessRules, ASecretThatAPageKnowsIsWorthMoreThanWhereItComesFrom) {
  const AccessRules rules = Rules("open-sesame");
  const WebRequest by_cookie{.target = "/",
                             .host = kHost,
                             .origin = "https://elsewhere.example",
                             .cookie = "runnel_token_8765=open-sesame"};
  EXPECT_FALSE(rules.Check(by_cookie));
  EXPECT_TRUE(rules.CheckOrigin(by_cookie));  // browsers send cookies for every page
  WebRequest by_address = by_cookie;
  by_address.target = "/?token=open-sesame";
  EXPECT_FALSE(rules.CheckOrigin(by_address));
}

TEST(AccessRules, TokensAreLongEnoughAndFitIntoAddresses) {
  EXPECT_TRUE(CheckToken("12345678"));
  EXPECT_TRUE(CheckToken("Ab-9._~xyz"));
  EXPECT_FALSE(CheckToken("1234567"));
  EXPECT_FALSE(CheckToken("with blank"));
  EXPECT_FALSE(CheckToken("with&sign"));
  EXPECT_FALSE(CheckToken(std::string(129, 'x')));
}

TEST(AccessRules, MadeTokensDiffer) {
  const auto a = MakeToken();
  const auto b = MakeToken();
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_EQ(a->size(), 32U);
  EXPECT_NE(*a, *b);
  EXPECT_TRUE(CheckToken(*a));
}

TEST(AccessRules, KnowsWhichAddressesOnlyThisMachineReaches) {
  for (const char* address : {"127.0.0.1", "127.3.2.1", "::1"}) EXPECT_TRUE(*IsLoopback(address));
  for (const char* address : {"0.0.0.0", "192.168.0.1", "::", "fe80::1"}) {
    EXPECT_FALSE(*IsLoopback(address)) << address;
  }
  for (const char* address : {"", "localhost", "127.0.0", "127.0.0.1:80"}) {
    const auto answer = IsLoopback(address);
    ASSERT_FALSE(answer) << address;
    EXPECT_THAT(answer.error().hint, HasSubstr("127.0.0.1"));
  }
}

}  // namespace

}  // namespace runnel::test
