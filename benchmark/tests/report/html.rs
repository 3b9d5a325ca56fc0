//! Pieces of HTML: what is escaped, kept together and aligned.

use proctor_benchmark::report::html::{Cell, Table, escape, paragraph};

#[test]
fn text_cannot_become_markup() {
    assert_eq!(
        escape("<script>\"a\" & 'b'</script>"),
        "&lt;script&gt;&quot;a&quot; &amp; &#39;b&#39;&lt;/script&gt;"
    );
    let mut table = Table::new("<b>", &["<em>"]);
    table.push_as("failed", ["<u>", "-1.5"]);
    table.push([Cell::linked("<s>", "<q>")]);
    let html = table.html();
    for tag in ["<b>", "<em>", "<u>", "<s>", "<q>"] {
        assert!(!html.contains(tag), "{html}");
    }
    assert!(html.contains("<td class=\"number\" data-label=\"\">-1.5</td>"));
}

#[test]
fn a_number_is_not_parted_from_its_exponent() {
    let whole = |word: &str| format!("<span class=\"whole\">{word}</span>");
    assert_eq!(
        paragraph("below 1.5e-9 of it, (2e-3), at 3 % a one-way e-bike `1e-9`"),
        format!(
            "<p>below {} of it, {} at 3\u{a0}% a one-way e-bike <code>1e-9</code></p>\n",
            whole("1.5e-9"),
            whole("(2e-3),"),
        )
    );
}

/// True if a table aligns this text as a number.
fn is_number(cell: &str) -> bool {
    let mut table = Table::new("", &["", ""]);
    table.push(["row", cell]);
    table.html().contains("<td class=\"number\"")
}

#[test]
fn what_begins_with_a_number_is_aligned_as_one() {
    for cell in ["3", "-1.5", "6 of 6", "1.2e-9 %", "2.7×", "+50.0 %"] {
        assert!(is_number(cell), "{cell}");
    }
    for cell in [
        "3D",
        "2D, plane strain",
        "",
        "-",
        "e",
        "at most 2",
        "1 of kinks, less 0.1",
    ] {
        assert!(!is_number(cell), "{cell}");
    }
}
