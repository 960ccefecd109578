use super::*;

#[test]
fn probe() {
    let good = include_str!("/work/main/cuts/tolkowsky.toml");
    let swap = |a: &str, b: &str| {
        assert!(good.contains(a), "{a}");
        good.replace(a, b)
    };
    let texts = [
        swap("table = 53.0", "table = \"53\""),
        swap("table = 53.0", "tabel = 53.0"),
        swap("table = 53.0", "table = 0.53"),
        swap("table = 53.0", ""),
        swap("table = 53.0", "table = nan"),
        swap("table = 53.0", "table = [53.0]"),
        swap("table = 53.0", "table = 53.0.0"),
        swap("table = 53.0", "table = 53.0\ntable = 53.0"),
        swap("table = 53.0", "table = \n 53.0"),
        swap("name = \"Tolkowsky 1919\"", ""),
        swap("name = \"Tolkowsky 1919\"", "name = 3"),
        swap("name = \"Tolkowsky 1919\"", "nome = 3"),
        swap("girdle_facets = 96", "girdle_facets = 96.0"),
        swap("girdle_facets = 96", "girdle_facets = -5"),
        swap("girdle_facets = 96", "girdle_facets = 99999999999999999999"),
        swap("crown_angle = 34.5 ", "crown_angle = 34.5\ncrown_height=3"),
        swap("crown_angle = 34.5 ", ""),
        swap("crown_angle = 34.5 ", "crown_angle = 0.602"),
        swap("material = \"diamond\"", "material = []"),
        swap("material = \"diamond\"", "material = true"),
        swap("material = \"diamond\"", "material = { index = 3, abbe = [1.5, 30] }"),
        swap("material = \"diamond\"", "material = { indx = 3, abbe = [1.5, 30] }"),
        swap("material = \"diamond\"", "material = { abbe = [1.5, 30, 3] }"),
        swap("material = \"diamond\"", "material = { abbe = [1.5, \"a\"] }"),
        swap("material = \"diamond\"", "material = { index=2, absorption = {} }"),
        swap("material = \"diamond\"", "material = { index=2, absorption = [[1]] }"),
        swap("material = \"diamond\"", "material = { index=2, absorption = -3 }"),
        swap("[round_brilliant]", "[round_brillant]"),
        swap("[round_brilliant]", "[[round_brilliant]]"),
        format!("{good}\n[[plane]]\nnormal=[0,0,1]\noffset=3"),
        format!("{good}\n[plane]\nnormal=[0,0,1]\noffset=3"),
        "format = 1".into(),
        "format = 1\nname=\"x\"\nmaterial=2\n".into(),
        "format = 1\nname=\"x\"\nmaterial=2\nplane=3".into(),
        "format = 1\nname=\"x\"\nmaterial=2\nplane=[3]".into(),
        "format = 1\nname=\"x\"\nmaterial=2\nround_brilliant=[3]".into(),
        "format = 1\nname=\"x\"\nmaterial=2\n[[plane]]\nnormal=[0,0,1]\noffset=3\n[[plane]]\nnormal=[0,0]\noffset=3".into(),
        "format = 1\nname=\"x\"\nmaterial=2\n[[plane]]\nnormal=[0,0,1]\noffset=3\n[[plane]]\nnormal=[0,0,\n\"x\"]\noffset=3".into(),
        "format = 1\nname=\"x\"\nmaterial=2\n[[plane]]\nnormal=[0,0,1]\noffset=3\n[[plane]]\nnormal=[0,0,0]\noffset=3".into(),
        "format = 1\nname=\"x\"\nmaterial=2\n[[plane]]\nnormal=[0,0,1]\noffset=3\n[[plane]]\noffset=3".into(),
        "format = 2\nname=\"x\"".into(),
        "format = \"1\"\nname=\"x\"".into(),
        "".into(),
        "\0".into(),
        "\u{feff}format=1".into(),
        "[".repeat(1000000),
        format!("format={}", "[".repeat(1000000)),
        format!("format=1\nname={}", "{a=".repeat(1000000)),
        "name = \"unclosed".into(),
        "é é = 3".into(),
        "source = '''\n\n\n".into(),
    ];
    for text in texts {
        match parse(&text, "x.toml") {
            Ok(_) => println!("OK {text}"),
            Err(error) => println!("{error}"),
        }
    }
    println!("{}", write(&parse(good, "").unwrap()));
}
