// The rules of words, names, types and constants.

#include <gtest/gtest.h>

#include "tests/plugins/genom_description/verdict.h"

namespace runnel::test {
namespace {

TEST(GenomWordsTest, NumbersAndTexts) {
  ExpectVerdicts({
      {kRight, ""},
      {kRight, "typedef double speed;\r\ntypedef float gain;\r\n"},
      {kRight, "const float a = 2e4; const double b = .25;"},
      {kRight, "const double a = 7.; const double b = 2.e-4f;"},
      {kRight, "const short a = 0x2A; const short b = 052; const unsigned short c = 42UL;"},
      {kRight, "const unsigned long a = 0xFFFFFFFF; const unsigned long b = 4294967295;"},
      {kWrong, "const unsigned long long a = 18446744073709551616;"},
      {kWrong, "const double a = 1.5d;"},
      {kRight, "const string a = \"one\" \" two\";"},
      {kRight, "const string a = \"over\nlines, with \\\" and ü\";"},
      {kWrong, "const string a = \"no end;"},
      {kRight, "const char a = 'q'; const char b = \"q\";"},
      {kWrong, "const char a = 'ab';"},
      {kWrong, "const char a = '';"},
      {kRight, "const char a = '\\n';"},
      {kWrong, "const char a = 65;"},
      {kWrong, "const string a = 'c';"},
      {kWrong, "typedef double größe;"},
      {kWrong, "typedef double a@b;"},
      {kRight, "typedef double _speed;"},
      {kRight, "/* of one */ typedef long a; // and the other\n"},
      {kWrong, "typedef long a; /* no end"},
  });
}

TEST(GenomWordsTest, WordsOfTheLanguageNameNothing) {
  for (const char* word : {"sequence", "octet", "module", "xor", "object", "native", "exception", "TRUE", "default"}) {
    EXPECT_NE(Wrongs(std::string("typedef double ") + word + ";"), "") << word;
  }
  for (const char* word : {"component", "task", "port", "in", "s", "ms", "handle", "yield", "pause", "codel", "true"}) {
    EXPECT_EQ(Wrongs(std::string("typedef double ") + word + ";"), "") << word;
  }
}

TEST(GenomWordsTest, OtherSpellings) {
  ExpectVerdicts({
      {kRight, "struct s <% long a<:2:>; %>;"},
      {kRight, "const long a = 6 xor 3 bitor 8 bitand compl 1;"},
      {kWrong, "const boolean a = not FALSE;"},
      {kWrong, "const boolean a = !FALSE;"},
      {kWrong, "module m { typedef long a; }; typedef sequence<::m::a> b;"},  // "<:" is '['
      {kRight, "module m { typedef long a; }; typedef sequence< ::m::a> b;"},
      {kRight, "typedef sequence<sequence<double>> a; typedef sequence<optional<string<4>>, 8> b;"},
      {kRight, "typedef sequence<double, 8 >> 1> a;"},
  });
}

TEST(GenomTypesTest, Structs) {
  ExpectVerdicts({
      {kRight, "struct pose { double x, y; double turn; };"},
      {kWrong, "struct pose { double x; long x; };"},
      {kWrong, "struct pose { };"},
      {kWrong, "struct { long a; };"},
      {kRight, "struct pose { double pose; };"},
      {kWrong, "module m { typedef long m; };"},
      {kRight, "struct a { struct b { long c; } d; }; typedef a::b e;"},
      {kWrong, "struct a { struct b { long c; } b; };"},
      {kWrong, "struct a { a b; };"},
      {kWrong, "struct a { unknown b; };"},
      {kRight, "module m { }; module m { typedef long a; }; typedef m::a b;"},
      {kWrong, "module m { typedef double a; }; module m { typedef double a; };"},
      {kWrong, "typedef long m; module m { };"},
      {kWrong, "module m { }; typedef long m;"},
      {kWrong, "typedef long a; typedef a a;"},
      {kRight, "typedef double a, b[3], c[2][2];"},
      {kWrong, "typedef double;"},
      {kWrong, "typedef double a"},
  });
}

TEST(GenomTypesTest, WhatDoesNotExist) {
  for (const char* type :
       {"int", "void", "long double", "unsigned char", "wchar", "wstring", "fixed<3,1>", "any", "size_t"}) {
    EXPECT_NE(Wrongs("typedef " + std::string(type) + " a;"), "") << type;
  }
}

TEST(GenomTypesTest, Sizes) {
  ExpectVerdicts({
      {kRight, "struct s { long a[0]; long b[2.0]; long c[4 * 2]; };"},
      {kWrong, "struct s { long a[-2]; };"},
      {kWrong, "struct s { long a[1.5]; };"},
      {kWrong, "struct s { long a[]; };"},
      {kRight, "typedef sequence<double, 0> a; typedef string<0> b;"},
      {kWrong, "typedef sequence<struct s { long a; }> b;"},
      {kWrong, "typedef optional<enum e { A }> b;"},
  });
}

TEST(GenomTypesTest, Enums) {
  ExpectVerdicts({
      {kRight, "enum side { LEFT, RIGHT };"},
      {kWrong, "enum side { LEFT, LEFT };"},
      {kWrong, "enum side { LEFT = 2 };"},
      {kWrong, "enum side { LEFT, };"},
      {kWrong, "enum side { };"},
      {kWrong, "enum side { LEFT }; enum hand { LEFT };"},
      {kRight, "module m { enum side { LEFT }; }; enum hand { LEFT };"},
  });
}

TEST(GenomTypesTest, WhatIsAnnounced) {
  ExpectVerdicts({
      {kRight, "struct tree; typedef sequence<tree> trees; struct tree { trees under; };"},
      {kRight, "union u; typedef sequence<u> us; union u switch(short) { case 2: us a; };"},
      {kRight, "struct s; struct s; struct s { long a; };"},
      {kWrong, "struct s; struct t { s a; }; struct s { long a; };"},
      {kWrong, "struct s;"},
      {kWrong, "struct s; union s switch(long) { case 1: long a; };"},
      {kWrong, "struct s; struct t { optional<s> a; }; struct s { t b; };"},
      {kWrong, "struct s { long a; }; struct s { long a; };"},
  });
}

TEST(GenomTypesTest, Unions) {
  ExpectVerdicts({
      {kRight, "union u switch(short) { case 3: case 4: double a; default: long b; };"},
      {kRight, "union u switch(short) { case 3: case 3: double a; };"},
      {kWrong, "union u switch(short) { case 3: double a; case 3: long b; };"},
      {kWrong, "union u switch(short) { default: double a; default: long b; };"},
      {kWrong, "union u switch(float) { case 3: double a; };"},
      {kWrong, "union u switch(octet) { case 3: double a; };"},
      {kWrong, "union u switch(string) { case \"a\": double a; };"},
      {kRight, "union u switch(boolean) { case TRUE: double a; };"},
      {kWrong, "union u switch(boolean) { case 1: double a; };"},
      {kRight, "union u switch(char) { case 'x': double a; };"},
      {kRight, "enum e { A, B }; union u switch(e) { case A: double a; case B: long b; };"},
      {kWrong, "enum e { A, B }; enum f { C }; union u switch(e) { case C: double a; };"},
      {kWrong, "union u switch(enum e { A }) { case A: double a; };"},
      {kWrong, "enum e { A }; union u switch(e) { case A: double e; };"},
      {kRight, "typedef short s; union u switch(s) { case 1 + 1: long a; default: string b; };"},
      {kWrong, "typedef float s; union u switch(s) { case 3: long a; };"},
      {kWrong, "typedef octet s; union u switch(s) { case 3: long a; };"},
      {kWrong, "union u switch(unsigned short) { case -1: long a; };"},
      {kWrong, "union u switch(short) { case 1: long a; case 2: long a; };"},
      {kWrong, "union u switch(short) { };"},
      {kWrong, "union u switch(short) { double a; };"},
  });
}

TEST(GenomTypesTest, Exceptions) {
  ExpectVerdicts({
      {kRight, "exception lost, late { double by; };"},
      {kRight, "exception late { double by; }; struct s { late a; };"},
      {kWrong, "exception lost; struct s { lost a; };"},
      {kWrong, "exception lost; typedef lost b;"},
      {kWrong, "exception lost; typedef sequence<lost> b;"},
      {kWrong, "exception lost; struct s { optional<lost> a; };"},
      {kRight, "exception late { struct when { long s; } at; }; typedef late::when w;"},
  });
}

TEST(GenomConstantsTest, Values) {
  ExpectVerdicts({
      {kRight, "const short a = 3.0; const double b = 3; const long c = -3;"},
      {kWrong, "const short a = 2.5;"},
      {kWrong, "const unsigned short a = -1;"},
      {kWrong, "const long a = TRUE;"},
      {kWrong, "const boolean a = 0;"},
      {kRight, "const boolean a = ~FALSE;"},
      {kRight, "const octet a = 999; const string<2> b = \"three\";"},  // only warned of
      {kWrong, "const long a = 2.0 / 0;"},
      {kWrong, "const long a = 2 / 0;"},
      {kWrong, "const double a = 1.0 / 0;"},
      {kWrong, "const double a = 0.0 / 0;"},
      {kWrong, "const double a = 1e999;"},
      {kWrong, "const double a = 1e300 * 1e300;"},
      {kRight, "const long long a = -9223372036854775808; const long long b = -(-5);"},
      {kWrong, "const long long a = -9223372036854775809;"},
      {kWrong, "const long long a = -18446744073709551615;"},
      {kWrong, "struct s { long a[-18446744073709551615]; };"},
      {kRight, "const unsigned long long a = 1 << 63; const long b = -8 << 2; const long c = 0 << 99;"},
      {kWrong, "const unsigned long long a = 1 << 64;"},
      {kWrong, "const unsigned long long a = 3 << 63;"},
      {kWrong, "const long long a = -3 << 63;"},
      {kRight, "struct s { long a[(-1 >> 64) + 2]; };"},
      {kWrong, "struct s { long a[-1 >> 64]; };"},
      {kWrong, "const long a = 2 % 0;"},
      {kRight, "const double a = 7 % 4 + (1 << 3) - 16 >> 2;"},
      {kWrong, "const long a = \"2\" + 1;"},
      {kWrong, "const long a = 1.5 % 2;"},
      {kRight, "const long a = 4; const long b = a * 2; struct s { long c[b]; };"},
      {kWrong, "const long a = b;"},
      {kWrong, "typedef long a; const long b = a;"},
      {kRight, "enum e { A, B }; const e c = B;"},
      {kWrong, "enum e { A }; enum f { B }; const e c = B;"},
      {kWrong, "enum e { A }; const e c = 0;"},
      {kWrong, "struct s { long a; }; const s b = 2;"},
      {kRight, "typedef double speed; const speed fast = 2;"},
  });
}

}  // namespace
}  // namespace runnel::test
