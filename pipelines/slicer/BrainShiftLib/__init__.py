# SPDX-License-Identifier: GPL-3.0-or-later
"""What is behind the widgets of the module Brain Shift."""
