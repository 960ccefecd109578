//! Lists the findings of an audit for `info`.

use brillianteer_cut::{Audit, Finding, FindingKind, tier_stem};
use brillianteer_math::{fixed, grouped};
use std::fmt::Write;

/// The most places that the list prints for alike findings; JSON has all.
const MOST_PLACES: usize = 3;

/// The most names of facets that a line of the list prints.
const MOST_NAMES: usize = 12;

/// Returns the audit as a list. Findings of one kind about the same tiers and of the same size share a line.
pub fn audit_list(audit: &Audit) -> String {
    if audit.findings.is_empty() {
        return "  audit: nothing found".to_owned();
    }
    let count = audit.findings.len();
    let candidates = if count == 1 { "candidate" } else { "candidates" };
    let mut text = format!("  audit: {count} {candidates}; whether one is a fault is for you to judge");
    for kind in FindingKind::ALL {
        let findings: Vec<&Finding> = audit.of_kind(kind).collect();
        let Some(first) = findings.first() else { continue };
        let limit = first.limit_text().map(|limit| format!(" ({limit})")).unwrap_or_default();
        let _ = write!(text, "\n  {kind}{limit}: {}", kind.meaning());
        for alike in grouped(findings, |a, b| key(a) == key(b)) {
            let _ = write!(text, "\n    {}", line(&alike));
        }
    }
    text
}

/// Returns the properties that findings on one line share: their tiers and their size as it is printed.
fn key(finding: &Finding) -> (Vec<&str>, String) {
    let mut tiers: Vec<&str> = finding.facets.iter().map(|name| tier_stem(name)).collect();
    tiers.sort_unstable();
    (tiers, finding.size_text())
}

fn line(alike: &[&Finding]) -> String {
    let first = alike[0];
    let mut text = first.size_text();
    if alike.len() > 1 {
        let _ = write!(text, ", {} times", alike.len());
    }
    let mut names: Vec<&str> = first.facets.iter().map(String::as_str).take(MOST_NAMES).collect();
    let more = format!("and {} more", first.facets.len() - names.len());
    if first.facets.len() > names.len() {
        names.push(&more);
    }
    let _ = write!(text, ": {}", names.join(", "));
    let places: Vec<String> =
        alike.iter().flat_map(|finding| finding.points.first()).take(MOST_PLACES).map(place).collect();
    if !places.is_empty() {
        let rest = if alike.len() > places.len() { ", ..." } else { "" };
        let _ = write!(text, "  at {}{rest}", places.join(", "));
    }
    text
}

fn place(point: &glam::DVec3) -> String {
    format!("({})", point.to_array().map(|at| fixed(at, 3)).join(", "))
}
