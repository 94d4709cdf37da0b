// Names of codes and elements, and how a failure travels.
#include "base/status.h"

#include <doctest/doctest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace isolod;

namespace {

#define ISOLOD_SPELLED(type, member) \
  { type::member, #member }

const std::vector<std::pair<Status::Code, std::string>> codes = {
    ISOLOD_SPELLED(Status, ok),
    ISOLOD_SPELLED(Status, cancelled),
    ISOLOD_SPELLED(Status, invalid_option),
    ISOLOD_SPELLED(Status, empty_mesh),
    ISOLOD_SPELLED(Status, too_large),
    ISOLOD_SPELLED(Status, index_out_of_range),
    ISOLOD_SPELLED(Status, position_not_finite),
    ISOLOD_SPELLED(Status, density_not_positive),
    ISOLOD_SPELLED(Status, budget_too_small),
    ISOLOD_SPELLED(Status, out_of_memory),
    ISOLOD_SPELLED(Status, no_convergence),
    ISOLOD_SPELLED(Status, sink_failed),
    ISOLOD_SPELLED(Status, cannot_open),
    ISOLOD_SPELLED(Status, unknown_format),
    ISOLOD_SPELLED(Status, syntax_error),
    ISOLOD_SPELLED(Status, truncated_file),
    ISOLOD_SPELLED(Status, unsupported_feature),
    ISOLOD_SPELLED(Status, invalid_result),
    ISOLOD_SPELLED(Status, not_admitted),
    ISOLOD_SPELLED(Status, wrong_arithmetic),
};

const std::vector<std::pair<Element, std::string>> elements = {
    {Element::none, ""},
    ISOLOD_SPELLED(Element, vertex),
    ISOLOD_SPELLED(Element, triangle),
    ISOLOD_SPELLED(Element, edge),
    ISOLOD_SPELLED(Element, line),
    ISOLOD_SPELLED(Element, byte),
    ISOLOD_SPELLED(Element, option),
    {Element::count, "vertices"},
    ISOLOD_SPELLED(Element, arithmetic),
};

/// Counts its calls, then answers.
Status answer(const Status& status, int& calls) {
  ++calls;
  return status;
}

Status through(const Status& first, const Status& second, int& calls) {
  ISOLOD_TRY(answer(first, calls));
  ISOLOD_TRY(answer(second, calls));
  return fail(Status::cancelled);
}

}  // namespace

TEST_CASE("status: every code is named as it is spelled, and no other number has a name") {
  // A code that is added to the enumeration and given a name, but is not listed above, is found here.
  for (unsigned value = 0; value < 256; ++value) {
    CAPTURE(value);
    std::string expected = "unknown";
    for (const auto& code : codes) {
      if (code.first == value) expected = code.second;
    }
    CHECK(name(static_cast<Status::Code>(value)) == expected);
  }
}

TEST_CASE("status: every element is named") {
  for (unsigned value = 0; value < 256; ++value) {
    CAPTURE(value);
    std::string expected;
    for (const auto& element : elements) {
      if (static_cast<unsigned>(element.first) == value) expected = element.second;
    }
    CHECK(name(static_cast<Element>(value)) == expected);
  }
}

TEST_CASE("status: each code has a message of its own, part of a sentence") {
  std::set<std::string> messages;
  for (const auto& code : codes) {
    const std::string text = message(code.first);
    CHECK(text != "failed");
    CHECK(text.back() != '.');
    messages.insert(text);
  }
  CHECK(messages.size() == codes.size());
  CHECK(std::string(message(static_cast<Status::Code>(200))) == "failed");
}

TEST_CASE("status: without arguments it is success; only that is ok") {
  CHECK(Status().is_ok());
  CHECK(Status().element == Element::none);
  CHECK(Status().value == 0);
  for (const auto& code : codes) {
    const Status status(code.first);
    CHECK(status.is_ok() == (code.first == Status::ok));
    CHECK(status == code.first);
    CHECK_FALSE(status != code.first);
    CHECK(status != static_cast<Status::Code>(code.first + 1));
  }
}

TEST_CASE("status: a failure keeps its element and all 64 bits of its value") {
  const Status status = fail(Status::out_of_memory, Element::byte, 0x123456789abcdef0U);
  CHECK(status == Status::out_of_memory);
  CHECK(status.element == Element::byte);
  CHECK(status.value == 0x123456789abcdef0U);
  CHECK(fail(Status::empty_mesh).element == Element::none);
  CHECK(fail(Status::empty_mesh).value == 0);
}

TEST_CASE("status: ISOLOD_TRY calls once, goes on after success and carries a failure up whole") {
  const Status bad = fail(Status::index_out_of_range, Element::triangle, 77);
  int calls = 0;
  CHECK(through({}, {}, calls) == Status::cancelled);
  CHECK(calls == 2);
  calls = 0;
  const Status carried = through(bad, {}, calls);
  CHECK(calls == 1);
  CHECK(carried == Status::index_out_of_range);
  CHECK(carried.element == Element::triangle);
  CHECK(carried.value == 77);
  calls = 0;
  CHECK(through({}, bad, calls) == Status::index_out_of_range);
  CHECK(calls == 2);
}
