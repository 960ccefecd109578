//! `completions` and `man`: print a shell's completion script, and manual pages.

use super::console::print;
use brillianteer_base::Failure;
use clap::{Args, Command};
use clap_complete::{Shell, generate};
use clap_mangen::Man;

/// The name of the program in completion scripts.
const NAME: &str = "brillianteer";

#[derive(Debug, Args)]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

impl Completions {
    /// Prints the script that completes the commands and options of `program`.
    pub fn run(&self, mut program: Command) -> Result<(), Failure> {
        let mut script = vec![];
        generate(self.shell, &mut program, NAME, &mut script);
        printed(&script)
    }
}

#[derive(Debug, Args)]
pub struct Manual {
    /// A command, for its own page
    command: Option<String>,
}

impl Manual {
    /// Prints the manual page of `program`, or of one of its commands.
    pub fn run(&self, mut program: Command) -> Result<(), Failure> {
        program.build();
        let asked = match &self.command {
            None => program,
            Some(name) => match program.find_subcommand(name) {
                Some(command) => command.clone(),
                None => {
                    let known: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
                    let message = format!("there is no command '{name}'; give one of {}", known.join(", "));
                    return Err(Failure::Usage(message));
                }
            },
        };
        let mut page = vec![];
        Man::new(asked).render(&mut page).map_err(|e| Failure::Output(format!("the page: {e}")))?;
        printed(&page)
    }
}

fn printed(text: &[u8]) -> Result<(), Failure> {
    print(String::from_utf8_lossy(text).trim_end())
}
