#include "base/hash.h"

#include <doctest/doctest.h>

using namespace isolod;

namespace {

template <class... T>
std::uint64_t hash_of(T... values) {
  ContentHash hash;
  (hash.add(values), ...);
  return hash.value();
}

int count_bits(std::uint64_t x) {
  int count = 0;
  for (; x != 0; x &= x - 1) ++count;
  return count;
}

}  // namespace

TEST_CASE("hash: golden values") {
  CHECK(hash_of() == 0xe9e0033e3badaf36U);
  CHECK(hash_of(1U) == 0x168081d7c97edd48U);
  CHECK(hash_of(1U, std::uint64_t{0x0123456789abcdef}) == 0x7e9f20956f09d75eU);
  CHECK(hash_of(1U, std::uint64_t{0x0123456789abcdef}, -1.5) == 0x289140aea89e6ec1U);
  CHECK(hash_of(1U, std::uint64_t{0x0123456789abcdef}, -1.5, 0.1F) == 0x8cbbf088fedcdc36U);
}

TEST_CASE("hash: values count, not types; order and number count") {
  CHECK(hash_of(std::uint8_t{7}) == hash_of(std::uint64_t{7}));
  CHECK(hash_of(0.5F) == hash_of(0.5));
  CHECK(hash_of(1.0) == hash_of(std::uint64_t{0x3ff0000000000000}));
  CHECK(hash_of(1U) != hash_of(1.0));
  CHECK(hash_of(0.0) != hash_of(-0.0));
  CHECK(hash_of(1U, 2U) != hash_of(2U, 1U));
  CHECK(hash_of(0U) != hash_of());
  CHECK(hash_of(0U, 0U) != hash_of(0U));
  ContentHash hash;
  hash.add(3U);
  CHECK(hash.value() == hash_of(3U));
  hash.add(4U);
  CHECK(hash.value() == hash_of(3U, 4U));
}

TEST_CASE("hash: opposite signs of neighbours do not cancel") {
  CHECK(hash_of(1.0, 2.0) != hash_of(-1.0, -2.0));
  CHECK(hash_of(1.0, 2.0, 3.0) != hash_of(-1.0, -2.0, 3.0));
  CHECK(hash_of(1.0, 2.0) != hash_of(2.0, 1.0));
  CHECK(hash_of(-1.0, 2.0) != hash_of(1.0, -2.0));
}

TEST_CASE("hash: one bit changed changes half of the bits") {
  int least = 64, most = 0, sum = 0, words = 0;
  double pairs = 0;
  for (std::uint64_t word = 0; word < 64; ++word) {
    const std::uint64_t value = word * word * 0x9e3779b97f4a7c15U;
    for (int bit = 0; bit < 64; ++bit) {
      for (int place = 0; place < 3; ++place) {
        std::uint64_t a[3] = {value, 5, word};
        const std::uint64_t before = hash_of(a[0], a[1], a[2]);
        a[place] ^= std::uint64_t{1} << bit;
        const int changed = count_bits(before ^ hash_of(a[0], a[1], a[2]));
        least = changed < least ? changed : least;
        most = changed > most ? changed : most;
        sum += changed, ++words;
        pairs += (changed - 32) * (changed - 32);
      }
    }
  }
  CHECK(least >= 10);
  CHECK(most <= 54);
  CHECK(double(sum) / words == doctest::Approx(32).epsilon(0.01));
  CHECK(pairs / words == doctest::Approx(16).epsilon(0.1));  // the variance of 64 fair coins
}

TEST_CASE("hash: 60,000 hashes of small inputs spread evenly over 4096 buckets") {
  static int bucket[4096];
  for (int& b : bucket) b = 0;
  for (std::uint32_t i = 0; i < 61440; ++i) ++bucket[hash_of(i, double(i % 7)) >> 52];
  double chi = 0;
  for (const int b : bucket) chi += (b - 15) * (b - 15) / 15.0;
  CHECK(chi > 3700);  // 4095 is expected, the deviation is 90
  CHECK(chi < 4500);
}
