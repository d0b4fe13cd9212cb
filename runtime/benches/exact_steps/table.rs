//! Tables for people, and for documents.

/// Rows of text under headings.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub fn new(headings: &[&str]) -> Self {
        Self {
            rows: vec![headings.iter().map(|&heading| heading.to_owned()).collect()],
        }
    }

    pub fn row(&mut self, cells: &[String]) {
        self.rows.push(cells.to_vec());
    }

    pub fn print(&self, markdown: bool) -> String {
        let columns = self.rows[0].len();
        let width = |column: usize| {
            let cells = self.rows.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let mut text = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            if markdown {
                text += &format!("| {} |\n", row.join(" | "));
                if i == 0 {
                    text += &format!("|{}\n", " --- |".repeat(columns));
                }
                continue;
            }
            for (cell, width) in row.iter().zip(&widths) {
                text += &format!("{cell:<width$}  ");
            }
            text = text.trim_end().to_owned() + "\n";
        }
        text
    }
}
