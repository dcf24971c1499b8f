// SPDX-License-Identifier: GPL-3.0-or-later
#include "discretise/node_cloud.hpp"
