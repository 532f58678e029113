#pragma once

// Something of every kind that scripts/mutate changes; what each function gives is in
// mutate_test.py.

namespace hn {
inline int Add(int a, int b) { return a + b; }
inline int Sub(int a, int b) { return a - b; }
}  // namespace hn

template <int kSize>
struct Sized {
  int values[kSize];
};

constexpr int kUsedAsSize = 4;
constexpr double kFactor = 3.0;

struct Counter {
  static constexpr int kStep = 5;
  int total = 0;
  Counter& operator+=(int by) {
    total += by;
    return *this;
  }
};

inline bool below(int a, int b) { return a < b; }

inline int nested(int a, int b, int c) {
  return a + b * (c - 1);  // three points, one within the other
}

inline bool both(bool a, bool b) { return a && !b; }

inline double negative(double x) { return -x * kFactor; }

template <typename Number>
Number twice(Number x) {
  return x + x;
}

inline int vectors(int a, int b) { return hn::Add(a, b); }

inline int firstEven(const int* values, int count) {
  for (int i = 0; i < count; ++i) {
    if (values[i] % 2 != 0) continue;
    return values[i];
  }
  return -1;
}

inline int clamped(int x) {
  if (x > 10) return 10;
  return x;
}

inline int sizes() { return static_cast<int>(sizeof(Sized<kUsedAsSize>)); }

inline int steps(bool often) {
  Counter counter;
  if (often) counter += Counter::kStep;
  counter +=  // on two lines
      Counter::kStep;
  return counter.total;
}
