# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures and measurements that only runs in three dimensions have."""
