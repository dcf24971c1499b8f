// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "solve/boundary/contact.hpp"
#include "solve/boundary/essential_conditions.hpp"
#include "solve/boundary/pushed_nodes.hpp"
#include "solve/device/clusters.hpp"
#include "solve/device/memory.hpp"

namespace brainshift::solve::device {

CompressedRows rows_of(const EssentialConditions::RowMatrix& matrix);
CompressedRows rows_of(const PushedNodes& nodes);

/// All entries, row by row.
std::vector<double> entries_of(const Eigen::SparseMatrix<double>& matrix);

/// Copies rows and what by_node() makes of them to a device.
void put_rows(const CompressedRows& rows, Memory& memory, SparseRows& to);

/// Copies a contact's nodes but not its skull. nodes: of the body.
void put_nodes(const Contact& contact, std::size_t nodes, Memory& memory, NodesInSkull& to);

}  // namespace brainshift::solve::device
