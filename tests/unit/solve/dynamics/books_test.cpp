// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/dynamics/books.hpp"

#include <gtest/gtest.h>

namespace brainshift::solve::books_test {

/// After so many looks at a body that holds a strain energy of 1 and this kinetic one, steps being half a joule off
/// each.
double off_after(int looks, double kinetic) {
  Books books;
  books.start();
  for (int look = 0; look < looks; ++look) {
    books.add(0, 0, 0.5, 0);
    books.look(1, kinetic);
  }
  return books.external_work - books.dissipated - 1 - kinetic;
}

TEST(Books, CountFromTheSecondLookAtAStartThatIsQuiet) {
  EXPECT_NEAR(off_after(1, 1e-4), 0, 1e-12);
  EXPECT_NEAR(off_after(2, 1e-4), 0, 1e-12);
  EXPECT_NEAR(off_after(3, 1e-4), 0.5, 1e-12);
}

TEST(Books, WaitForQuickMotionsToDieDownButNotForever) {
  EXPECT_NEAR(off_after(5, 0.1), 0, 1e-12);
  EXPECT_NEAR(off_after(6, 0.1), 0.5, 1e-12);
}

TEST(Books, CountAtOnceWhereABodyStartsAtRest) {
  Books books;
  books.add(0, 0, 0.5, 0);
  books.add(0, 0, 0.5, 0);
  books.look(1, 0.1);
  EXPECT_EQ(books.external_work, 0.5);
}

}  // namespace brainshift::solve::books_test
