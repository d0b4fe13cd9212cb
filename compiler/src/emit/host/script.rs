//! JavaScript modules for three.js.

use super::Hosted;

impl Hosted<'_> {
    /// A GLSL chunk: a string to put in front of a shader's own code.
    pub(super) fn three(&self) -> String {
        format!(
            "{}\nexport const {} = /* glsl */ `\n{}`;\n",
            self.head(),
            self.base(),
            self.printed.text()
        )
    }

    /// Node functions: each with those that it calls.
    pub(super) fn tsl(&self) -> String {
        let mut out = self.head();
        let mut imports = vec!["wgslFn"];
        let head: Vec<&str> = self
            .printed
            .head
            .iter()
            .chain(&self.printed.uniforms)
            .map(|p| p.trim_end())
            .collect();
        let mut always = Vec::new();
        let mut body = String::new();
        if !head.is_empty() {
            imports.insert(0, "wgsl");
            always.push("declarations".to_owned());
            body.push_str(&format!(
                "const declarations = wgsl(`\n{}\n`);\n\n",
                head.join("\n\n")
            ));
        }
        for function in &self.printed.functions {
            let is_asked = self
                .built
                .functions
                .iter()
                .any(|b| b.handle == function.handle);
            let called = function.calls.iter();
            let called = called.filter_map(|&k| Some(self.printed.functions.get(k)?.name.clone()));
            let includes: Vec<String> = always.iter().cloned().chain(called).collect();
            let list = if includes.is_empty() {
                String::new()
            } else {
                format!(", [{}]", includes.join(", "))
            };
            let word = if is_asked { "export const" } else { "const" };
            body.push_str(&format!(
                "{word} {} = wgslFn(`\n{}\n`{list});\n\n",
                function.name,
                function.text.trim_end()
            ));
        }
        out.push_str(&format!(
            "\nimport {{ {} }} from 'three/tsl';\n\n",
            imports.join(", ")
        ));
        out.push_str(body.trim_end());
        out.push('\n');
        out
    }
}
