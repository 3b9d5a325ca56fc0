use proctor_verification::mill::{draw, ladder::{self, Faults}};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let (seed, from, count): (u64,u64,u64) = (a[1].parse().unwrap(), a[2].parse().unwrap(), a[3].parse().unwrap());
    for n in from..from+count {
        let mut attempt = 0;
        let p = loop { match draw::problem(seed, n, attempt) { Ok(p) => break Some(p), Err(e) => { attempt += 1; println!("# {n} refused: {e}"); if attempt > 50 {break None} } } };
        let Some(p) = p else { continue };
        let t = std::time::Instant::now();
        let mut errs = vec![]; let mut fail = None;
        for &c in &p.ladder { match ladder::run(&p, c, &Faults::default()) { Ok(e) => errs.push(e), Err(e) => { fail = Some(e); break } } }
        print!("{n:4} {:8} {}D {:14} {:28}", p.family.word(), p.axes(), p.material.kind.word(), p.method.to_string());
        if let Some(f) = fail { println!(" FAIL {f}"); continue }
        for w in errs.windows(2).zip(p.ladder.windows(2)) { let (e,c)=w; let cc=[c[0],c[1]];
            print!(" u {:5.2} s {:5.2}", ladder::order([e[0].displacement,e[1].displacement],cc), ladder::order([e[0].stress,e[1].stress],cc));
            if let (Some(a),Some(b))=(e[0].variable,e[1].variable) { print!(" a {:5.2}", ladder::order([a,b],cc)); } }
        let l = errs.last().unwrap();
        println!("  eu {:.2e} es {:.2e} ea {:.1e} {:?} steps {} {:.2}s", l.displacement, l.stress, l.variable.unwrap_or(0.0), p.method.weighting, p.steps(*p.ladder.last().unwrap()).1, t.elapsed().as_secs_f64());
    }
}
