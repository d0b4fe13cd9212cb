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

    /// The parameters as uniforms of three.js, and the functions that take the rest.
    fn parameter_nodes(&self, imports: &mut Vec<&str>) -> String {
        imports.push("uniform");
        let is_used = |name: &String| {
            let mut arguments = self.built.functions.iter().flat_map(|f| &f.arguments);
            arguments.any(|(used, _)| used == name)
        };
        let nodes: Vec<String> = self
            .program
            .params()
            .iter()
            .map(|param| (self.emission.name_of(&param.name), param.default))
            .filter(|(name, _)| is_used(name))
            .map(|(name, default)| format!("{name}: uniform({default:?})"))
            .collect();
        let mut out = format!(
            "// uniforms: parameters.NAME.value = NUMBER sets one\nexport const parameters = {{ {} }};\n\n",
            nodes.join(", ")
        );
        for function in &self.built.functions {
            let printed = self.printed.functions.iter();
            let mut named = printed.filter(|f| f.handle == function.handle);
            if let Some(function) = named.next() {
                let name = &function.name;
                out.push_str(&format!(
                    "export const {name} = (inputs) => {name}_node({{ ...parameters, ...inputs }});\n"
                ));
            }
        }
        out
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
            let (word, name) = match (is_asked, self.holds_parameters) {
                (true, true) => ("const", format!("{}_node", function.name)),
                (true, false) => ("export const", function.name.clone()),
                _ => ("const", function.name.clone()),
            };
            body.push_str(&format!(
                "{word} {name} = wgslFn(`\n{}\n`{list});\n\n",
                function.text.trim_end()
            ));
        }
        if self.holds_parameters {
            body.push_str(&self.parameter_nodes(&mut imports));
        }
        imports.sort_unstable();
        out.push_str(&format!(
            "\nimport {{ {} }} from 'three/tsl';\n\n",
            imports.join(", ")
        ));
        out.push_str(body.trim_end());
        out.push('\n');
        out
    }
}
