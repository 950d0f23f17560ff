// The rules of components, interfaces, ids and ports.

#include <gtest/gtest.h>

#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

TEST(GenomComponentsTest, DeclarationsAndNames) {
  ExpectVerdicts({
      {kRight, "component nav;"},
      {kRight, "component nav { };"},
      {kRight, "component nav { typedef long a; }; component nav { typedef a b; };"},
      {kWrong, "interface nav; component nav;"},
      {kWrong, "module m { component nav; };"},
      {kWrong, "component nav { component inner; };"},
      {kWrong, "component nav }"},
      {kWrong, "component nav { "},
      {kRight, "component nav { struct s { long a; }; const long n = 3; module m { typedef s b; }; };"},
      {kWrong, "component nav { typedef long nav; };"},
      {kWrong, "component nav { typedef long start; };"},
      {kWrong, "component nav { const long ether = 2; };"},
      {kWrong, "component nav { typedef long pause; };"},
      {kRight, "interface nav { typedef long stop; typedef long pause; };"},
      {kWrong, "component nav; service go() { };"},
  });
}

TEST(GenomComponentsTest, Properties) {
  ExpectVerdictsInComponent({
      {kRight, "doc \"a\"; doc \"b\" \"c\"; version \"1\"; lang \"c++\"; email \"a@b\";"},
      {kWrong, "version 1.0;"},
      {kWrong, "language: \"c\";"},
      {kRight, "version \"1\"; version \"2\"; email \"a\"; email \"b\";"},  // the first holds
      {kRight, "lang \"c\"; lang \"c\";"},
      {kWrong, "lang \"c\"; lang \"c++\";"},
      {kRight, "lang \"fortran\";"},
      {kRight, "require \"a\", \"b\"; requires \"b\"; codels-require \"c\"; codels-requires \"d\";"},
      {kWrong, "clock-rate 2 ms; clock-rate 2 ms;"},
      {kRight, "clock-rate 2 ms; task t { period 4 ms; }; task u { period 6 ms; delay 2 ms; };"},
      {kWrong, "clock-rate 2 ms; task t { period 5 ms; };"},
      {kWrong, "clock-rate 2 ms; task t { period 4 ms; delay 1 ms; };"},
      {kWrong, "period 5 ms;"},
      {kWrong, "priority 5;"},
      {kRight, "stack 64k;"},
      {kWrong, "codel k();"},
      {kWrong, "local long a;"},
      {kRight, "exception e; throw e; exception f; throw f, e;"},
      {kWrong, "typedef double e; throw e;"},
      {kWrong, "throw e; exception e;"},
  });
}

TEST(GenomComponentsTest, Ids) {
  ExpectVerdictsInComponent({
      {kRight, "ids { double a; }; ids { double b, c[2]; struct s { long d; } e; };"},
      {kWrong, "ids { double a; }; ids { double a; };"},
      {kWrong, "ids { };"},
      {kWrong, "ids { any a; };"},
      {kRight, "native n; ids { n a; sequence<n> b; };"},
      {kWrong, "ids { struct s { long d; } e; }; typedef s f;"},
      {kRight, "ids { struct s { long d; } e; }; typedef ids::s f;"},
      {kWrong, "typedef long ids; ids { long a; };"},
  });
}

TEST(GenomComponentsTest, Ports) {
  ExpectVerdictsInComponent({
      {kRight, "typedef double d; port in d a; port out d b { doc \"c\"; }; port multiple out d e;"},
      {kWrong, "port in double a;"},
      {kWrong, "port in sequence<double> a;"},
      {kRight, "port in struct s { long b; } a;"},
      {kWrong, "typedef double d; port d a;"},
      {kWrong, "typedef double d; port in multiple d a;"},
      {kWrong, "typedef double d; port in d a; port out d a;"},
      {kWrong, "typedef double a; port in a a;"},
      {kWrong, "typedef double d; port in d start;"},
      {kWrong, "typedef double d; port in d pause;"},
      {kWrong, "typedef double d; port in d a; function a();"},
      {kWrong, "typedef double d; function a(); port in d a;"},
      {kWrong, "typedef double d; exception e; port in d a { throw e; };"},
      {kWrong, "typedef double d; port in d a { period 5ms; };"},
      {kWrong, "native n; port in n a;"},
      {kWrong, "native n; struct s { sequence<n> b; }; port in s a;"},
      {kWrong, "struct s { any b; }; port in s a;"},
      {kWrong, "port in unknown a;"},
  });
}

TEST(GenomInterfacesTest, WhatIsProvided) {
  const std::string stop = "interface stoppable { function halt(in long how); };";
  ExpectVerdicts({
      {kRight, stop + "component c { provides stoppable; };"},
      {kRight, stop + "component c { provides stoppable; function halt(in long how) { codel k(in how); }; };"},
      {kWrong, stop + "component c { provides stoppable; function halt(in long other); };"},
      {kWrong, stop + "component c { provides stoppable; function halt(in double how); };"},
      {kWrong, stop + "component c { provides stoppable; function halt(out long how); };"},
      {kWrong, stop + "component c { provides stoppable; function halt(); };"},
      {kWrong, stop + "component c { provides stoppable; function halt(in long how, in long when); };"},
      {kWrong, stop + "component c { provides stoppable; attribute halt(); };"},
      {kWrong, "component c { provides nothing; };"},
      {kWrong, "component d; component c { provides d; };"},
      {kWrong, stop + "component c { provides stoppable, stoppable; };"},
      {kRight, stop + "interface other { function halt(in long how); }; component c { provides stoppable, other; };"},
      {kWrong, stop + "interface other { function halt(in double how); }; component c { provides stoppable, other; };"},
      {kRight,
       "interface i { ids { long a; }; }; component c { ids { long b; }; provides i; function f() { codel k(in a, in "
       "b); }; };"},
      {kWrong, "interface i { ids { long a; }; }; component c { ids { long a; }; provides i; };"},
      {kRight, "interface i { version \"3\"; doc \"d\"; }; component c { version \"4\"; doc \"e\"; provides i; };"},
      {kRight, "interface i { typedef long a; }; component c { provides i; typedef i::a b; };"},
      {kWrong, "interface i { typedef long a; }; component c { provides i; typedef a b; };"},
      {kRight, "interface i { activity go() { doc \"d\"; }; };"},
      {kWrong, "interface i { activity go() { doc \"d\"; }; }; component c { provides i; };"},
      {kRight,
       "interface i { activity go(); }; component c { provides i; task t; activity go() { task t; codel<start> k() "
       "yield ether; }; };"},
      {kRight, "interface i { function f(); }; interface j { extends i; }; component c { provides j; function f(); };"},
      {kWrong, "interface i { extends i; };"},
      {kWrong,
       "interface i { typedef long d; port in d p; }; component c { typedef long d; port in d p; provides i; };"},
  });
}

TEST(GenomInterfacesTest, WhatIsUsed) {
  ExpectVerdicts({
      {kRight, "interface i { function f(in long a); }; component c { uses i; };"},
      {kWrong, "interface i { function f(); }; component c { uses i; function f(); };"},
      {kWrong, "interface i { function f(); }; component c { provides i; uses i; };"},
      {kWrong, "interface i { typedef long d; port out d p; }; component c { provides i; uses i; };"},
      {kRight,
       "interface i { typedef long d; port out d p; }; component c { uses i; task t { codel<start> k(in p) yield "
       "ether; }; };"},
      {kWrong,
       "interface i { typedef long d; port out d p; }; component c { uses i; task t { codel<start> k(out p) yield "
       "ether; }; };"},
      {kRight,
       "interface i { struct s { long a; }; }; interface j { struct s { double a; }; }; component c { uses i, j; };"},
      {kRight, "interface i { function f(); }; component c { uses i; task t { codel<start> k(in f) yield ether; }; };"},
      {kWrong,
       "interface i { function f(); }; component c { uses i; task t { codel<start> k(out f) yield ether; }; };"},
      {kWrong, "interface i { function f(); }; component c { uses i; function g() { codel k(remote in f); }; };"},
  });
}

TEST(GenomPragmasTest, Verdicts) {
  ExpectVerdicts({
      {kRight, "interface i { function f(); };\n#pragma provides i\ncomponent c { function f() { codel k(); }; };"},
      {kWrong, "#pragma provides i\ncomponent c;"},
      {kRight, "struct s { long a; };\n#pragma masquerade runnel s Pose2\n"},
      {kWrong, "#pragma masquerade runnel s Pose2\nstruct s { long a; };"},
      {kWrong, "struct s { long a; };\n#pragma masquerade runnel s\n"},
      {kWrong, "struct s { long a; };\n#pragma masquerade runnel s A\n#pragma masquerade runnel ::s B\n"},
      {kRight, "struct s { long a; };\n#pragma masquerade runnel s A\n#pragma masquerade ros s \"B C\"\n"},
      {kRight, "#pragma nothing that is known\n#pragma requires \"some-package >= 2\"\ncomponent c;"},
  });
}

}  // namespace
}  // namespace runnel::test
