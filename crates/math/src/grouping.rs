//! Divides a list into groups of similar members.

/// Groups things. Each thing joins the first group whose first member is similar to it, or begins a new group. Groups
/// and their members stay in order.
pub fn grouped<T>(things: impl IntoIterator<Item = T>, alike: impl Fn(&T, &T) -> bool) -> Vec<Vec<T>> {
    let mut groups: Vec<Vec<T>> = vec![];
    for thing in things {
        match groups.iter_mut().find(|group| alike(&group[0], &thing)) {
            Some(group) => group.push(thing),
            None => groups.push(vec![thing]),
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thing_joins_the_first_group_that_began_near_it() {
        let near = |a: &u32, b: &u32| a.abs_diff(*b) < 2;
        assert_eq!(grouped([5, 1, 6, 7, 2], near), [vec![5, 6], vec![1, 2], vec![7]]);
        assert_eq!(grouped(0..0, |_, _| true), Vec::<Vec<i32>>::new());
    }
}
