#include "sample.h"

#include <cstdio>
#include <cstring>

// Prints what the functions give; with "weak" or "good" it tests one of them.
int main(int count, char** arguments) {
  if (count > 1) {
    const bool good = std::strcmp(arguments[1], "good") == 0;
    return below(1, 2) && (!good || !below(2, 2)) ? 0 : 1;
  }
  const int values[] = {3, 4};
  const int size = sizes() / static_cast<int>(sizeof(int));
  std::printf("%d %d %d %g %d %d %d %d %d %d %d\n", below(2, 2), nested(7, 2, 4), both(true, true),
              negative(2.0), twice(3), vectors(5, 3), firstEven(values, 2), clamped(12), size,
              steps(true), steps(false));
}
