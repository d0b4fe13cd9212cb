//! Attributes in Metal's language, which a C++ compiler takes for anything: those of entry points are judged by the tables of the
//! Metal Shading Language Specification, section 5.2.

/// Attributes without a number, and with one.
const PLAIN: [&str; 5] = [
    "position",
    "vertex_id",
    "stage_in",
    "thread_position_in_grid",
    "thread_position_in_threadgroup",
];
const NUMBERED: [(&str, u32); 2] = [("buffer", 30), ("color", 7)];

/// What is wrong with the attributes of a text.
pub(super) fn wrong_attributes(text: &str) -> Option<String> {
    let kinds = ["kernel ", "vertex ", "fragment "];
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if kinds.iter().all(|kind| !line.starts_with(kind)) {
            if let Some(wrong) = attribute(line).and_then(|found| of_known(found).err()) {
                return Some(wrong);
            }
            continue;
        }
        let mut taken = Vec::new();
        for parameter in lines.by_ref().take_while(|l| !l.starts_with(')')) {
            let Some(found) = attribute(parameter) else {
                return Some(format!("a parameter without an attribute: {parameter}"));
            };
            let is_buffer = parameter.contains("constant ") || parameter.contains("device ");
            if is_buffer != found.starts_with("buffer(") || taken.contains(&found) {
                return Some(format!("a parameter's place: {parameter}"));
            }
            if let Err(wrong) = of_known(found) {
                return Some(wrong);
            }
            taken.push(found);
        }
    }
    None
}

/// The attribute on a line.
fn attribute(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once("[[")?;
    Some(rest.split_once("]]")?.0)
}

fn of_known(attribute: &str) -> Result<(), String> {
    let number = |name: &str| {
        attribute
            .strip_prefix(name)?
            .strip_prefix('(')?
            .strip_suffix(')')
    };
    let is_numbered = |&(name, most): &(&str, u32)| {
        number(name).is_some_and(|n| n.parse::<u32>().is_ok_and(|n| n <= most))
    };
    if PLAIN.contains(&attribute) || NUMBERED.iter().any(is_numbered) {
        Ok(())
    } else {
        Err(format!("[[{attribute}]] is no attribute of Metal's"))
    }
}

#[cfg(test)]
mod tests {
    use super::wrong_attributes;

    fn kernel(parameters: &str) -> String {
        format!("kernel void main_of(\n{parameters}\n) {{\n}}\n")
    }

    #[test]
    fn places_are_judged() {
        let good =
            "  metal::uint3 id [[thread_position_in_grid]]\n, constant View& view [[buffer(0)]]";
        assert_eq!(wrong_attributes(&kernel(good)), None);
        let twice = format!("{good}\n, device float* image [[buffer(0)]]");
        for wrong in [
            twice.as_str(),
            ", constant View& view [[user(fake0)]]",
            ", constant View& view",
            ", constant View& view [[buffer(31)]]",
            ", float x [[texture(0)]]",
        ] {
            assert!(wrong_attributes(&kernel(wrong)).is_some(), "{wrong}");
        }
    }
}
