#include "tests/plugins/web_server/web_server_fixture.h"

namespace runnel::test {

namespace {

class WebPages : public WebServerTest {};

TEST_F(WebPages, AreGivenByTheirPaths) {
  Start();
  const std::string page = Client().Get("/");
  EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(page, HasSubstr("Content-Type: text/html\r\n"));
  EXPECT_THAT(page, HasSubstr("\r\n\r\n<p>page</p>"));
  const std::string script = Client().Get("/page.js?version=1");
  EXPECT_THAT(script, HasSubstr("Content-Type: text/javascript\r\n"));
  EXPECT_THAT(script, HasSubstr("let page = 1"));
}

TEST_F(WebPages, SeveralAreGivenOverOneConnection) {
  Start();
  RawClient client = Client();
  EXPECT_THAT(client.Get("/"), HasSubstr("<p>page</p>"));
  EXPECT_THAT(client.Get("/page.js"), HasSubstr("let page = 1"));
  EXPECT_THAT(client.Get("/", "Connection: close\r\n"), HasSubstr("<p>page</p>"));
  EXPECT_TRUE(client.IsClosed());
}

TEST_F(WebPages, OnlyTheHeadIsGivenToWhoAsksForThat) {
  Start();
  RawClient client = Client();
  client.Send("HEAD / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  const std::string answer = client.Read();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 200 OK\r\n"));
  EXPECT_THAT(answer, HasSubstr("Content-Length: 11\r\n"));
  EXPECT_THAT(answer, ::testing::EndsWith("\r\n\r\n"));
}

TEST_F(WebPages, ForbidFramesForeignScriptsAndGuessing) {
  Start();
  const std::string page = Client().Get("/");
  EXPECT_THAT(page, HasSubstr("X-Content-Type-Options: nosniff\r\n"));
  EXPECT_THAT(page, HasSubstr("X-Frame-Options: DENY\r\n"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(page, HasSubstr("script-src 'self';"));
  EXPECT_THAT(page, HasSubstr("connect-src 'self' ws://" + Client().host() + " "));
}

TEST_F(WebPages, NothingElseIsFound) {
  Start();
  for (const char* target : {"/../etc/passwd", "/..%2f..%2fetc/passwd", "/%2e%2e/etc/passwd", "//etc/passwd",
                             "/page.js/", "/page.js%00", "/PAGE.JS", "/./page.js", "/page.js#x", "/page", "etc/passwd",
                             "*", "\\", "http://127.0.0.1/page.js", "file:///etc/passwd"}) {
    EXPECT_THAT(Client().Get(target), StartsWith("HTTP/1.1 404 ")) << target;
  }
}

TEST_F(WebPages, CannotBeWritten) {
  Start();
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "PATCH", "CONNECT"}) {
    RawClient client = Client();
    client.Send(std::string(method) + " / HTTP/1.1\r\nHost: localhost\r\n\r\n");
    const std::string answer = client.Read();
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 405 ")) << method;
    EXPECT_THAT(answer, HasSubstr("Allow: GET, HEAD\r\n")) << method;
  }
}

TEST_F(WebPages, AreNotGivenUnderAForeignName) {
  Start();
  RawClient client = Client();
  client.Send("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n");
  const std::string answer = client.Read();
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 421 "));
  EXPECT_THAT(answer, Not(HasSubstr("<p>page</p>")));
  EXPECT_THAT(answer, HasSubstr("not called 'evil.example'"));
}

// The files of the page are no secret, and a browser that has none yet needs them to ask for the token.
TEST_F(WebPages, AreGivenWithoutTheTokenAndSayWhichRoleOneHas) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}, {WebRole::kLook, "just-look-7"}}});
  EXPECT_THAT(server->url(), Not(HasSubstr("sesame")));
  EXPECT_EQ(server->made_token(), "");
  EXPECT_THAT(Client().Get("/"), HasSubstr("<p>page</p>"));
  const std::string refusal = Client().Get("/access");
  EXPECT_THAT(refusal, StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(refusal, HasSubstr("#token="));
  const std::string wrong = Client().Get("/access", "Authorization: Bearer guess-guess\r\n");
  EXPECT_THAT(wrong, StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(wrong, Not(HasSubstr("guess-guess"))) << "what is shown stands in no answer";
  EXPECT_THAT(Client().Get("/access", "Authorization: Bearer open-sesame\r\n"), HasSubstr("\r\n\r\nchange"));
  EXPECT_THAT(Client().Get("/access", "Authorization: Bearer just-look-7\r\n"), HasSubstr("\r\n\r\nlook"));
}

TEST_F(WebPages, ATokenIsMadeWhereOthersCanReachTheAddress) {
  Start({.address = "0.0.0.0", .is_insecure = true});
  EXPECT_THAT(Client().Get("/access"), StartsWith("HTTP/1.1 401 "));
  EXPECT_EQ(server->made_token().size(), 32U);
  EXPECT_THAT(server->url(), Not(HasSubstr(server->made_token())));
  EXPECT_THAT(Client().Get("/access?token=" + server->made_token()), HasSubstr("\r\n\r\nchange"));
}

TEST_F(WebPages, APortThatIsTakenIsAnErrorWithACure) {
  Start();
  const auto second = WebServer::Start({.port = server->port()}, {}, {});
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().message, HasSubstr("port " + std::to_string(server->port())));
  EXPECT_THAT(second.error().message, HasSubstr("is taken by another program"));
  EXPECT_THAT(second.error().hint, HasSubstr("0 for any that is free"));
}

TEST_F(WebPages, APortIsFreeAgainAfterTheServer) {
  Start();
  const std::uint16_t port = server->port();
  RawClient client = Client();
  EXPECT_THAT(client.Get("/"), HasSubstr("<p>page</p>"));
  server.reset();
  EXPECT_TRUE(client.IsClosed());
  EXPECT_TRUE(WebServer::Start({.port = port}, {}, {}));
}

TEST_F(WebPages, PlacesThatAreNoneAreErrors) {
  const auto no_address = WebServer::Start({.address = "here", .port = 0}, {}, {});
  ASSERT_FALSE(no_address);
  EXPECT_THAT(no_address.error().message, HasSubstr("'here' is not an address"));
  const auto foreign = WebServer::Start({.address = "203.0.113.7", .port = 0, .is_insecure = true}, {}, {});
  ASSERT_FALSE(foreign);
  EXPECT_THAT(foreign.error().message, HasSubstr("no address of this machine"));
}

}  // namespace

}  // namespace runnel::test
