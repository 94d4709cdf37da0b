// JSON: values by their place, and each error at its byte.
#include "io/json.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "support/block.h"

using namespace isolod;

namespace {

/// A parsed text.
struct Parsed {
  explicit Parsed(std::string from, std::size_t bytes = 1 << 16) : text(std::move(from)), block(bytes) {
    status = json.parse({reinterpret_cast<const unsigned char*>(text.data()), text.size()}, 1000, block.arena);
  }
  std::uint32_t at(const char* key) const { return json.find(Json::root, key); }
  double number(std::uint32_t token) const {
    double value = 0;
    CHECK(json.number(token, -1, value).is_ok());
    return value;
  }

  std::string text;
  support::Block block;
  Json json;
  Status status;
};

const std::string sample =
    "{\"a\": 1.5e1, \"list\": [true, [1, 2, [3]], {\"a\": 7}, \"x\\\"y\"], \"o\": {\"a\": -2, \"p\": {}},"
    "\t\r\n\"a\": 99, \"last\": null}";

}  // namespace

TEST_CASE("json: members are found in their own object, the first of equal ones") {
  const Parsed p(sample);
  REQUIRE(p.status.is_ok());
  CHECK(p.number(p.at("a")) == 15);
  CHECK(p.number(p.json.find(p.at("o"), "a")) == -2);
  CHECK(p.at("p") == Json::missing);
  CHECK(p.at("aa") == Json::missing);
  CHECK(p.at("last") != Json::missing);
  CHECK(p.json.find(p.at("a"), "a") == Json::missing);  // no object
  CHECK(p.json.find(Json::missing, "a") == Json::missing);
  CHECK(p.json.find(p.json.find(p.at("o"), "p"), "a") == Json::missing);
}

TEST_CASE("json: an array's items, each once and whole") {
  const Parsed p(sample);
  const std::uint32_t list = p.at("list");
  std::vector<std::uint32_t> walked;
  for (std::uint32_t t = p.json.first(list); t != Json::missing; t = p.json.after(t, list)) walked.push_back(t);
  REQUIRE(walked.size() == 4);
  CHECK(p.json.is_true(walked[0]));
  CHECK(p.number(p.json.first(walked[1])) == 1);
  CHECK(p.number(p.json.find(walked[2], "a")) == 7);
  CHECK(p.json.is_string(walked[3], "x\\\"y"));
  support::Block block;
  Span<std::uint32_t> items;
  REQUIRE(p.json.items(list, items, block.arena).is_ok());
  CHECK(std::vector<std::uint32_t>(items.begin(), items.end()) == walked);
  CHECK(p.json.first(p.at("o")) == Json::missing);
  CHECK(p.json.first(Json::missing) == Json::missing);
  const Parsed empty("[]");
  CHECK(empty.json.first(Json::root) == Json::missing);
}

TEST_CASE("json: a literal is no string, a key is no value") {
  const Parsed p("[true, \"true\", false, \"\"]");
  const std::uint32_t yes = p.json.first(Json::root), text = p.json.after(yes, Json::root);
  const std::uint32_t no = p.json.after(text, Json::root), empty = p.json.after(no, Json::root);
  CHECK(p.json.is_true(yes));
  CHECK_FALSE(p.json.is_true(text));
  CHECK_FALSE(p.json.is_true(no));
  CHECK_FALSE(p.json.is_true(Json::missing));
  CHECK(p.json.is_string(text, "true"));
  CHECK_FALSE(p.json.is_string(yes, "true"));
  CHECK(p.json.is_string(empty, ""));
  CHECK_FALSE(p.json.is_string(text, "tru"));
}

TEST_CASE("json: counts are whole numbers from 0 to 2^53; what is missing has its default") {
  const auto count = [](const std::string& text, std::uint64_t& value) {
    const Parsed p("[" + text + "]");
    REQUIRE(p.status.is_ok());
    return p.json.count(p.json.first(Json::root), 5, value);
  };
  std::uint64_t value = 0;
  CHECK((count("0", value).is_ok() && value == 0));
  CHECK((count("1e3", value).is_ok() && value == 1000));
  CHECK((count("9007199254740992", value).is_ok() && value == 9007199254740992U));
  CHECK((count("", value).is_ok() && value == 5));
  for (const char* bad : {"-1", "0.5", "9007199254740994", "1e300", "\"1\"", "true", "[1]"}) {
    CAPTURE(std::string(bad));
    const Status status = count(bad, value);
    CHECK(status == Status::syntax_error);
    CHECK(status.element == Element::byte);
  }
}

TEST_CASE("json: errors name their byte in the file") {
  struct Case {
    const char* text;
    Status::Code code;
    std::uint64_t byte;
  };
  const Case cases[] = {
      {"", Status::truncated_file, 0},         {"{", Status::truncated_file, 1},
      {"[1,", Status::truncated_file, 3},      {"\"ab", Status::truncated_file, 3},
      {"\"a\\", Status::truncated_file, 3},    {"[1 2]", Status::syntax_error, 3},
      {"[,1]", Status::syntax_error, 1},       {"[1,]", Status::syntax_error, 3},
      {"{\"a\":1,}", Status::syntax_error, 7}, {"{\"a\" 1}", Status::syntax_error, 5},
      {"{1:2}", Status::syntax_error, 1},      {"[1}", Status::syntax_error, 2},
      {"{]", Status::syntax_error, 1},         {"]", Status::syntax_error, 0},
      {"{\"a\":}", Status::syntax_error, 5},   {"1 1", Status::syntax_error, 2},
      {"[tru]", Status::syntax_error, 1},      {"[-]", Status::syntax_error, 1},
      {"[+1]", Status::syntax_error, 1},       {"[-inf]", Status::syntax_error, 1},
      {"[nan]", Status::syntax_error, 1},      {"{\"a\"}", Status::syntax_error, 4},
  };
  for (const Case& c : cases) {
    CAPTURE(std::string(c.text));
    const Parsed p(c.text);
    CHECK(p.status == c.code);
    CHECK(p.status.element == Element::byte);
    CHECK(p.status.value == 1000 + c.byte);
  }
}

TEST_CASE("json: nesting of any depth is parsed without recursion, and any arena does or is refused") {
  const std::size_t depth = 200000;
  const Parsed deep(std::string(depth, '[') + std::string(depth, ']'), std::size_t{8} << 20);
  CHECK(deep.status.is_ok());
  bool enough = false;
  for (std::size_t bytes = 1; bytes < 2000 && !enough; bytes += 16) {
    const Parsed p(sample, bytes);
    enough = p.status.is_ok();
    if (!enough) CHECK(p.status == Status::out_of_memory);
  }
  CHECK(enough);
}
