//! Comparisons, logic and choice.

use naga::{BinaryOperator, UnaryOperator};

use super::{Derivative, Gpu, Row, Typing, Weight};
use crate::ir::Prim;

pub fn rows() -> Vec<Row> {
    let order = |prim, mnemonic, usage, doc, op| Row {
        prim,
        mnemonic,
        names: &[],
        usage,
        doc,
        typing: Typing::Order,
        real: None,
        complex: None,
        derivative: Derivative::Zero,
        gpu: Gpu::Binary(op),
        gpu_complex: "",
        cost: Weight {
            real: 1,
            complex: 0,
        },
    };
    let equality = |prim, mnemonic, usage, doc, op| Row {
        typing: Typing::Equality,
        cost: Weight {
            real: 1,
            complex: 3,
        },
        ..order(prim, mnemonic, usage, doc, op)
    };
    let logic = |prim, mnemonic, usage, doc, op| Row {
        typing: Typing::Logic(2),
        ..order(prim, mnemonic, usage, doc, op)
    };
    vec![
        order(
            Prim::Less,
            "less",
            "a < b",
            "whether a is below b",
            BinaryOperator::Less,
        ),
        order(
            Prim::LessEqual,
            "lessequal",
            "a <= b",
            "whether a is not above b",
            BinaryOperator::LessEqual,
        ),
        equality(
            Prim::Equal,
            "equal",
            "a == b",
            "whether both are equal",
            BinaryOperator::Equal,
        ),
        equality(
            Prim::NotEqual,
            "notequal",
            "a != b",
            "whether both differ",
            BinaryOperator::NotEqual,
        ),
        logic(
            Prim::And,
            "and",
            "a and b",
            "both",
            BinaryOperator::LogicalAnd,
        ),
        logic(
            Prim::Or,
            "or",
            "a or b",
            "at least one",
            BinaryOperator::LogicalOr,
        ),
        Row {
            typing: Typing::Logic(1),
            gpu: Gpu::Unary(UnaryOperator::LogicalNot),
            ..order(
                Prim::Not,
                "not",
                "not a",
                "the opposite",
                BinaryOperator::Equal,
            )
        },
        Row {
            typing: Typing::Select,
            derivative: Derivative::Structural,
            gpu: Gpu::Structural,
            cost: Weight {
                real: 1,
                complex: 2,
            },
            ..order(
                Prim::Select,
                "select",
                "if c then a else b",
                "a where c holds, else b",
                BinaryOperator::Equal,
            )
        },
    ]
}
