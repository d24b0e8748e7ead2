//! `polycube view`.

use super::{CellKind, Example, Sandbox, bent, coarse};
use serde_json::Value;

fn page(sandbox: &Sandbox, name: &str) -> String {
    String::from_utf8(sandbox.read(name)).unwrap()
}

fn data(page: &str) -> Value {
    let start = r#"<script type="application/json" id="data">"#;
    let text = page.split(start).nth(1).unwrap().split("</script>").next().unwrap();
    serde_json::from_str(text).unwrap()
}

/// How many bytes a base64 text stands for.
fn bytes(value: &Value) -> usize {
    let text = value.as_str().unwrap();
    text.len() / 4 * 3 - text.bytes().rev().take_while(|b| *b == b'=').count()
}

#[test]
fn the_page_holds_all_it_needs() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::CubeSpikes, CellKind::Tetrahedra);
    sandbox.write_mesh("spikes.mesh", &mesh);
    sandbox.write_mesh("bent.mesh", &bent(&mesh));
    let told = sandbox.ok("view spikes.mesh --shape bent.mesh -o new/page.html");
    assert_eq!(told, "new/page.html\n");
    let page = page(&sandbox, "new/page.html");
    assert!(page.len() < 2_000_000, "{}", page.len());
    let namespaces = page.matches("http://www.w3.org/1999/").count();
    assert_eq!(page.matches("http://").count() + page.matches("https://").count(), namespaces);
    for way_out in ["src=", "href=", "@import", "import(", "url(", "XMLHttpRequest", "WebSocket", "sendBeacon", "@@"] {
        assert!(!page.contains(way_out), "{way_out}");
    }
    assert!(page.contains("default-src 'none'") && page.contains("<title>spikes</title>"));
    assert!(page.contains("Permission is hereby granted"), "the licence of three.js");
}

#[test]
fn the_data_has_every_step_with_its_layout() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::SteppedL, CellKind::Quads);
    sandbox.write_mesh("l.obj", &mesh);
    sandbox.write_mesh("bent.obj", &bent(&mesh));
    sandbox.ok("view l.obj --shape bent.obj -o page.html -q --strategy paper");
    sandbox.ok("simplify l.obj -o out --strategy paper -q");
    let (data, report) = (data(&page(&sandbox, "page.html")), sandbox.json("out/report.json"));
    let steps = data["steps"].as_array().unwrap();
    assert_eq!((&steps[0]["counts"], &steps.last().unwrap()["counts"]), (&report["before"], &report["after"]));
    let rounds = report["rounds"].as_array().unwrap();
    assert_eq!(steps.len(), rounds.len() + 2);
    for (step, round) in steps[1..].iter().zip(rounds) {
        assert_eq!((&step["counts"], &step["pairs"]), (&round["counts"], &round["pairs"]));
    }
    let layouts = data["layouts"].as_array().unwrap();
    for step in steps {
        let (layout, counts) = (&layouts[step["layout"].as_u64().unwrap() as usize], &step["counts"]);
        let [blocks, padded, patches] =
            ["blocks", "blocks_padded", "surface_patches"].map(|n| counts[n].as_u64().unwrap() as usize);
        assert_eq!(bytes(&layout["blocks"]), 12 * blocks);
        assert_eq!(bytes(&layout["faces"]["ids"]), 4 * (padded - blocks));
        assert_eq!(bytes(&layout["patches"]["corners"]), 12 * patches);
        assert_eq!(bytes(&layout["points"]), 12 * mesh.points().len());
    }
    assert_eq!(bytes(&data["shape"]), 12 * mesh.points().len());
    assert_eq!(bytes(&data["triangles"]), 24 * mesh.cells().len());
    assert_eq!(data["convex"].as_array().unwrap().len(), 78);
    assert!(data["hexes"].is_null());
}

#[test]
fn a_volume_is_shown_by_its_surface_and_hexahedra_by_their_quality() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::Ring, CellKind::Hexahedra);
    sandbox.write_mesh("ring.vtu", &mesh);
    sandbox.write_mesh("bent.vtu", &bent(&mesh));
    sandbox.ok("view ring.vtu --hexes bent.vtu -o page.html --up z");
    let data = data(&page(&sandbox, "page.html"));
    let hexes = &data["hexes"];
    assert_eq!(bytes(&hexes["cells"]), 32 * mesh.cells().len());
    assert_eq!(bytes(&hexes["quality"]), 4 * mesh.cells().len());
    assert_eq!(hexes["statistics"]["cells"], mesh.cells().len());
    assert!(hexes["statistics"]["min"].as_f64().unwrap() < 1.0);
    assert!(bytes(&data["layouts"][0]["points"]) <= 12 * mesh.points().len());
    assert_eq!((&data["up"], &data["shape"]), (&2.into(), &Value::Null));
    sandbox.ok("simplify ring.vtu -o out -q");
    let last = data["steps"].as_array().unwrap().last().unwrap();
    assert_eq!(last["counts"], sandbox.json("out/report.json")["after"]);
}

/// Width, height and the pixels of a PNG file.
fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

#[test]
fn the_picture_has_its_size_and_shows_blocks_and_lines() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::CubeSpikes, CellKind::Triangles);
    sandbox.write_mesh("spikes.obj", &mesh);
    sandbox.write_mesh("bent.obj", &bent(&mesh));
    for (options, rows) in [("", 1), ("--shape bent.obj", 2)] {
        sandbox.ok(&format!("view spikes.obj -o page.html --png picture.png --png-size 100 {options}"));
        let bytes = sandbox.read("picture.png");
        let (width, height, pixels) = decoded(&bytes);
        assert_eq!((width, height), (200, 100 * rows));
        // Each part: white around, lines, and colours between.
        for part in 0..2 * rows {
            let (left, top) = (part % 2 * 100, part / 2 * 100);
            let own = pixels.chunks(3).enumerate().filter(|(i, _)| {
                let (x, y) = (*i as u32 % width, *i as u32 / width);
                (left..left + 100).contains(&x) && (top..top + 100).contains(&y)
            });
            let own: Vec<&[u8]> = own.map(|(_, p)| p).collect();
            let count = |wanted: fn(&[u8]) -> bool| own.iter().filter(|p| wanted(p)).count();
            assert!(count(|p| p == [255; 3]) > 2000, "white in {part}");
            assert!(count(|p| p.iter().all(|x| *x < 100)) > 200, "lines in {part}");
            assert!(count(|p| p.iter().max().unwrap() - p.iter().min().unwrap() > 30) > 1000, "colours in {part}");
        }
        sandbox.ok(&format!("view spikes.obj -o page.html --png again.png --png-size 100 {options}"));
        assert!(bytes == sandbox.read("again.png"));
    }
}

#[test]
fn what_cannot_be_shown_is_told() {
    let sandbox = Sandbox::new();
    let mesh = coarse(Example::SteppedL, CellKind::Quads);
    sandbox.write_mesh("l.obj", &mesh);
    sandbox.write_mesh("ring.obj", &coarse(Example::Ring, CellKind::Quads));
    sandbox.fails("view l.obj", 2, &["--output"]);
    sandbox.fails("view l.obj -o page.html --png p.png --png-size 5", 2, &["16"]);
    sandbox.fails("view l.obj -o page.html --png p.jpg", 2, &["pictures are PNG", ".png"]);
    sandbox.fails("view l.obj -o page.html --png-size 100", 2, &["--png"]);
    sandbox.fails("view l.obj --shape ring.obj -o page.html", 3, &["the shape 838"]);
    sandbox.fails("view l.obj --hexes l.obj -o page.html", 3, &["not of hexahedra"]);
    sandbox.fails("view none.obj -o page.html", 1, &["none.obj"]);
    sandbox.fails("view l.obj -o .", 2, &["name a file"]);
    assert_eq!(sandbox.names("."), ["l.obj", "ring.obj"]);
}
