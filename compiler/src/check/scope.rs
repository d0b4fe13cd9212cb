//! Names that hold at a place of the text, the innermost meaning first. Every step takes constant time.

use rustc_hash::FxHashMap;

/// Names with what they stand for.
#[derive(Clone, Debug)]
pub struct Scope<'a, T> {
    entries: Vec<Entry<'a, T>>,
    /// Place of the innermost entry of each name.
    innermost: FxHashMap<&'a str, usize>,
}

#[derive(Clone, Debug)]
struct Entry<'a, T> {
    name: &'a str,
    meaning: T,
    /// Place of the entry of the same name that this one hides.
    hidden: Option<usize>,
}

impl<T> Default for Scope<'_, T> {
    fn default() -> Self {
        Self {
            entries: Vec::new(),
            innermost: FxHashMap::default(),
        }
    }
}

impl<'a, T> Scope<'a, T> {
    /// A name begins to hold.
    pub fn push(&mut self, name: &'a str, meaning: T) {
        let hidden = self.innermost.insert(name, self.entries.len());
        self.entries.push(Entry {
            name,
            meaning,
            hidden,
        });
    }

    /// What the name stands for.
    pub fn get(&self, name: &str) -> Option<&T> {
        let place = self.innermost.get(name)?;
        self.entries.get(*place).map(|entry| &entry.meaning)
    }

    /// [`Self::get`], to be changed.
    pub fn get_mut(&mut self, name: &str) -> Option<&mut T> {
        let place = self.innermost.get(name)?;
        self.entries.get_mut(*place).map(|entry| &mut entry.meaning)
    }

    /// Number of entries, to be given to [`Self::truncate`].
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// The names that began to hold since there were `len` of them end to hold.
    pub fn truncate(&mut self, len: usize) {
        while self.entries.len() > len
            && let Some(entry) = self.entries.pop()
        {
            match entry.hidden {
                Some(place) => self.innermost.insert(entry.name, place),
                None => self.innermost.remove(entry.name),
            };
        }
    }

    /// Every name with what it stands for, hidden ones included, in the order in which they began to hold.
    pub fn entries(&self) -> impl Iterator<Item = (&'a str, &T)> + '_ {
        self.entries
            .iter()
            .map(|entry| (entry.name, &entry.meaning))
    }

    /// Every name, hidden ones included.
    pub fn names(&self) -> impl Iterator<Item = &'a str> + '_ {
        self.entries.iter().map(|entry| entry.name)
    }
}

impl<'a, T> FromIterator<(&'a str, T)> for Scope<'a, T> {
    fn from_iter<I: IntoIterator<Item = (&'a str, T)>>(entries: I) -> Self {
        let mut out = Self::default();
        for (name, meaning) in entries {
            out.push(name, meaning);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Scope;

    #[test]
    fn inner_names_hide_outer_ones() {
        let mut scope: Scope<u32> = [("a", 1), ("b", 2)].into_iter().collect();
        let outer = scope.len();
        scope.push("a", 3);
        assert_eq!(scope.get("a"), Some(&3));
        scope.truncate(outer);
        assert_eq!((scope.get("a"), scope.get("b")), (Some(&1), Some(&2)));
        scope.truncate(0);
        assert_eq!(scope.get("a"), None);
    }
}
