//! The reference against the 60-digit tables and against Annex G.

mod oracle;
mod special;
