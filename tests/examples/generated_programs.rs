//! Prints the generated programs with the point at which each is evaluated, for `tests/oracle/generated.py`.

#[path = "../tests/support/formulas.rs"]
mod formulas;
#[path = "../tests/support/listing.rs"]
mod listing;

fn main() {
    print!("{}", listing::listing(&listing::programs()));
}
