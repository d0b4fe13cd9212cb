//! Names of the user in shading languages, most of which have no letters but Latin ones.

/// The name with Greek letters spelt out and subscripts as digits: `θ₁` is `theta1`.
#[must_use]
pub fn identifier(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        match (greek(c), u32::from(c)) {
            (Some(word), _) => out.push_str(word),
            (None, code @ 0x2080..=0x2089) => {
                out.extend(char::from_digit(code - 0x2080, 10));
            }
            (None, _) => out.push(c),
        }
    }
    out
}

fn greek(c: char) -> Option<&'static str> {
    Some(match c {
        'α' => "alpha",
        'β' => "beta",
        'γ' => "gamma",
        'δ' => "delta",
        'ε' | 'ϵ' => "epsilon",
        'ζ' => "zeta",
        'η' => "eta",
        'θ' | 'ϑ' => "theta",
        'ι' => "iota",
        'κ' => "kappa",
        'λ' => "lambda",
        'μ' => "mu",
        'ν' => "nu",
        'ξ' => "xi",
        'ο' => "omicron",
        'π' => "pi",
        'ρ' | 'ϱ' => "rho",
        'σ' | 'ς' => "sigma",
        'τ' => "tau",
        'υ' => "upsilon",
        'φ' => "phi",
        'χ' => "chi",
        'ψ' => "psi",
        'ω' => "omega",
        'Γ' => "Gamma",
        'Δ' => "Delta",
        'Θ' => "Theta",
        'Λ' => "Lambda",
        'Ξ' => "Xi",
        'Π' => "Pi",
        'Σ' => "Sigma",
        'Φ' => "Phi",
        'Ψ' => "Psi",
        'Ω' => "Omega",
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::identifier;

    #[test]
    fn greek_is_spelt_out() {
        let check = |name, latin: &str| assert_eq!(identifier(name), latin);
        check("θ₁", "theta1");
        check("speed_2", "speed_2");
        check("Δx", "Deltax");
    }
}
