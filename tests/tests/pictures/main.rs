// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//! Pictures of whole scenes on Mesa's software Vulkan.

mod golden;
mod steady;
