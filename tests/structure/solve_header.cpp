// SPDX-License-Identifier: GPL-3.0-or-later
// The face of the solver, as the first thing that a program includes.
#include "solve/solve.hpp"
